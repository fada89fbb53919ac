// What the reference says about a target density on a map: the exact side of every comparison.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/gate/row_bands.h"
#include "lightproof/image/target_density.h"
#include "lightproof/image/texel_luminance.h"
#include "lightproof/samplers/sampler.h"
#include "reference/estimator_moments.h"
#include "reference/mapped_texels.h"
#include "reference/rosenblatt_transform.h"

namespace lightproof {

/// The bins over (phi, theta) in which the gate counts directions.
inline constexpr Extent kGateBins = {32, 16};

/// The integrals that the estimator is tested on: irradiance for two normals. One looks at a pole,
/// one at the horizon, because densities trade places between them.
struct MeanCase {
  std::string_view name;
  Direction normal;
};
inline constexpr std::size_t kMeanCaseCount = 2;
extern const std::array<MeanCase, kMeanCaseCount> kMeanCases;

/// The exact side of one test case.
struct Expectation {
  DensitySpace density_space = DensitySpace::solid_angle;  ///< how the mass lies inside a texel
  Mapping mapping = {};             ///< how the square of the texels lies on the sphere
  Lookup lookup = Lookup::nearest;  ///< how the estimators look `luminance` up
  TexelLuminance luminance;         ///< radiance that the estimators gather
  SharedGrid<double> masses;        ///< probabilities of texels
  Grid<double> bins;                ///< probabilities of kGateBins, over (phi, theta)
  std::vector<double> rows;         ///< probabilities of the rows of texels
  std::vector<double> columns;      ///< probabilities of the columns of texels
  /// Writes the transformed coordinates of samples, cos(theta) of whose positions are known; all
  /// spans are of one size. Empty where the distribution inside a texel is not known in closed
  /// form.
  std::function<void(std::span<const TexelSample> samples, std::span<const double> cosines,
                     std::span<reference::RosenblattPoint> points)>
      transform;
  /// Probability of every row that `transform` names, of texels or of bilinear patches; empty if it
  /// names none.
  std::vector<double> smooth_rows;
  std::vector<RowBand> bands;             ///< bands of `smooth_rows`
  std::vector<std::uint8_t> band_of_row;  ///< for each of `smooth_rows` the index of its band
  /// Declared density over the square where it is not `masses` spread inside the texels as
  /// `density_space` says; see declared_density().
  std::function<double(SquarePoint at)> density;
  /// Moments of the estimators of kMeanCases that draw from the declared density.
  std::array<reference::EstimatorMoments, kMeanCaseCount> estimators;
  /// Moments of the estimators of kMeanCases that draw uniformly over the sphere.
  std::array<reference::EstimatorMoments, kMeanCaseCount> uniform;
  /// Moments of 1/p(omega) over the texels at least a tenth as bright as the mean, 0 elsewhere.
  reference::EstimatorMoments inverse_pdf;

  /// What is looked up of a sample's texel besides its radiance, in a byte: it stays in the cache.
  enum TexelFlag : std::uint8_t {
    has_mass = 1,
    counts_as_bright = 2,  ///< see is_bright
  };
  Grid<std::uint8_t> flags;  ///< for each texel the sum of its TexelFlag values
  /// Where texels are no rows and columns of bins: which of their shares lie in which bin.
  std::shared_ptr<const reference::BinShares> shares = {};
  /// The parts of texels that lie in one bin each, for integrals of many pdfs; null on a map whose
  /// bins are rows and columns, or that has too many texels to keep them.
  std::shared_ptr<const std::vector<reference::BinnedPart>> parts = {};
  /// The masses of kGateBins, given masses of texels that are spread inside them as these are.
  Grid<double> bins_of(const Grid<double>& texel_masses) const;
  /// Sets the flags, once masses, luminance and mean_luminance are known.
  void set_flags();

  /// Whether a texel of this radiance (its own, whatever the look-up) belongs to the part of the
  /// map over which 1/p is averaged.
  bool is_bright(double radiance) const { return radiance >= 0.1 * mean_luminance; }
  double mean_luminance = 0.0;
  /// Cells over the square in which the density is smooth: it may have edges between texels, or
  /// between the quarters around their centres.
  Extent smooth_cells() const;

  /// The measure in which positions inside a texel are uniform.
  MapMeasure positions() const { return position_measure(density_space, mapping); }

  /// Whether samplers of this distribution add up its masses and search the sums.
  bool is_summed = false;
};

/// The effect w that rounding of all sums of masses to steps of 1 would have on average: it grows
/// in proportion to the step. Cells are pooled until `samples` expect 25 of each. Of an
/// interpolated map the sums are of patches, of which a texel has a quarter of four: where it is
/// smooth, the effect is half as large.
struct RoundingEffect {
  double texels = 0.0;  ///< effect on the counts of texels
  double rows = 0.0;    ///< effect on the counts of rows
};

/// Sets the probabilities of the rows that the transform names, and the bands of these rows.
void set_smooth_rows(Expectation& expectation, std::vector<double> masses);

/// The effect of rounding on a distribution, 0 where its masses are not summed.
RoundingEffect rounding_effect(const Expectation& expectation, std::uint64_t samples);

/// The part of the exact side of a target density on a map, which outlives it, that says how texels
/// are drawn: masses, rows, columns, density, transform and flags. It has no bins and no moments,
/// which take long. Throws InputError if the map is black.
Expectation texel_expectation_of(const EnvironmentMap& map, TargetDensity target);
Expectation texel_expectation_of(EnvironmentMap&& map, TargetDensity target) = delete;

/// The exact side of a target density on a map, which outlives it. Throws InputError if the map is
/// black.
Expectation expectation_of(const EnvironmentMap& map, TargetDensity target);
Expectation expectation_of(EnvironmentMap&& map, TargetDensity target) = delete;

/// expectation_of() a map that lasts as long as it.
std::shared_ptr<const Expectation> shared_expectation_of(std::shared_ptr<const EnvironmentMap> map,
                                                         TargetDensity target);

}  // namespace lightproof
