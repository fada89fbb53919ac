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
#include "reference/mapped_texels.h"

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
  double integral = 0.0;  ///< ∫ of the pdf over the square
  Grid<double> bins;      ///< masses of kGateBins by the pdf, over that integral
};

/// Integrates pdf() by 2 x 3 Gauss-Legendre nodes (s x t) in every cell, which is split where bins
/// begin and over t into pieces of at most 1/64. A density that inside a cell is linear over s, and
/// linear times sin(pi t) over t, is integrated to a relative 1e-10 whatever the grid; another one
/// as well as it is smooth inside a cell.
/// On maps of another mapping than Lightproof's own frame bins are cut out of texels by
/// reference::visit_binned_parts(), and the pdf is that of the centre of each part.
/// `parts` are all of these, if they are kept.
OwnDensity integrate_pdf(const BoundSampler& sampler, Extent cells, const Mapping& mapping = {},
                         const std::vector<reference::BinnedPart>* parts = nullptr);

/// Checks that a pdf integrates to 1: |∫ pdf ds dt - 1| <= 1e-6.
CheckResult check_pdf_integral(const OwnDensity& own);

/// A check draws as many random points as the run has samples, but no more than this.
inline constexpr std::uint64_t kMostCheckPoints = std::uint64_t{1} << 16U;

/// Checks at `count` random points that pdf(sample(u).at) is what sample(u) returned, to 1e-5.
CheckResult check_returned_pdf(const BoundSampler& sampler, const RandomStream& stream,
                               std::uint64_t count);

/// Checks at edge_points() that the sample stays on the map and inside its texel, and that the
/// texel has light. The points next to 1 are a check of their own, the first of the two: where sums
/// end too early, they run off.
std::array<CheckResult, 2> check_edges(const BoundSampler& sampler, const Expectation& expectation);

/// Checks that pdf() is positive where the declared density is, or the sampler declares that its
/// rounding may lose so little light; and 0 where the declared density is 0. The deviation is the
/// share of all light that the pdf calls unreachable.
CheckResult check_support(const DensityComparison& density);

/// Checks that pdf() is the declared density at every cell's centre, to 1e-5 and what the sampler
/// declares of its rounding. The deviation is the largest relative one, of cells that can be
/// reached.
CheckResult check_declared_density(const DensityComparison& density);

/// What can be said of a sampler whatever the seed. What its source cannot serve keeps its initial
/// value.
struct Inspection {
  OwnDensity own;
  DensityComparison density;
  std::array<CheckResult, 2> edges;
  /// "one column to the right": where pdf() is what sample() returns, at every point where that is
  /// not the pdf of the sample's own position; none if there is no such point or position.
  std::optional<std::string_view> returned_pdf_of;
  bool has_pdf = true;       ///< BoundSampler::has_pdf() of the sampler
  bool has_weights = true;   ///< BoundSampler::has_weights of the sampler
  bool takes_points = true;  ///< BoundSampler::takes_points() of the sampler
  /// Whether `density` compares the densities that came with samples, where there is no pdf().
  bool compares_samples = false;
};
/// Inspects a sampler, given the rounding that it declares.
Inspection inspect(const BoundSampler& sampler, const Expectation& expectation,
                   const MassRounding& rounding);

/// Checks that a sampler returns the same texel as another one at the same point: at edge_points(),
/// and at `count` random ones.
CheckResult check_same_texel(const BoundSampler& sampler, const BoundSampler& other,
                             const Expectation& expectation, const RandomStream& stream,
                             std::uint64_t count);

/// Points at the edges of the random numbers' range and around the CDF entries of the marginal and
/// of the conditional distributions of rows: of all, or of as many as about 2^18 points allow.
std::vector<SquarePoint> edge_points(const Expectation& expectation);

}  // namespace lightproof
