// Checks that need no statistics: what a sampler must do for certain points, exactly.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/density_check.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/results/test_id.h"

namespace lightproof {

/// The outcome of one check: the size of the worst deviation, and where it was seen.
struct CheckResult {
  TestId test;
  bool passed = true;
  double worst = 0.0;
  std::string detail;
};

/// What a sampler's own pdf says that it draws.
struct OwnDensity {
  double integral = 0.0;  ///< over the square
  Grid<double> bins;      ///< masses of kGateBins, over the integral
};

/// Integrates pdf() by 2 x 3 Gauss-Legendre nodes in every cell, split where bins begin and along t
/// into pieces of at most 1/64. A density that is linear across a cell, and linear times sin(pi t)
/// along it, is integrated to a relative 1e-10 whatever the grid; another one as well as it is
/// smooth inside a cell.
OwnDensity integrate_pdf(const BoundSampler& sampler, Extent cells);

/// |∫ pdf ds dt - 1| <= 1e-6.
CheckResult check_pdf_integral(const OwnDensity& own);

/// Random points of a check beside the draws: as many, but no more than this.
inline constexpr std::uint64_t kMostCheckPoints = std::uint64_t{1} << 16U;

/// pdf(sample(u).at) equals the pdf that sample(u) returned, to 1e-5, at so many points.
CheckResult check_returned_pdf(const BoundSampler& sampler, const RandomStream& stream,
                               std::uint64_t count);

/// At edge_points(): the sample stays on the map, inside its texel, and that texel has light. The
/// points next to 1 are a check of their own: where sums end too early, they run off.
std::array<CheckResult, 2> check_edges(const BoundSampler& sampler, const Expectation& expectation);

/// pdf() is positive where the declared density is, or the sampler declares that its rounding may
/// lose so little light; and 0 where that is 0. The deviation is the share of all light that the
/// pdf calls unreachable.
CheckResult check_support(const DensityComparison& density);

/// pdf() is the declared density at every cell's centre, to 1e-5 and what the sampler declares of
/// its rounding. The deviation is the largest relative one, of cells that can be reached.
CheckResult check_declared_density(const DensityComparison& density);

/// What can be said of a sampler whatever the seed. What its source cannot do is left as it is.
struct Inspection {
  OwnDensity own;
  DensityComparison density;
  std::array<CheckResult, 2> edges;
  /// "one column to the right": where pdf() is what sample() returns, at every point where that is
  /// not the pdf of the sample's own position; none if there is no such point or position.
  std::optional<std::string_view> returned_pdf_of;
  bool has_pdf = true;       ///< as the BoundSampler
  bool has_weights = true;   ///< as the BoundSampler
  bool takes_points = true;  ///< as the BoundSampler
};
Inspection inspect(const BoundSampler& sampler, const Expectation& expectation,
                   const MassRounding& rounding);

/// The same texel as another sampler for the same point: edge_points(), and so many random ones.
CheckResult check_same_texel(const BoundSampler& sampler, const BoundSampler& other,
                             const Expectation& expectation, const RandomStream& stream,
                             std::uint64_t count);

/// Points at the edges of the random numbers' range and around the CDF entries of the marginal and
/// of the conditional distributions of rows: of all, or of as many as about 2^18 points allow.
std::vector<SquarePoint> edge_points(const Expectation& expectation);

}  // namespace lightproof
