// The tests of the gate, each by an identifier: what it is called, what its numbers mean. Strings
// stand only where results are printed or written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lightproof/core/enumeration.h"

namespace lightproof {

/// What a test holds the samples against.
enum class Oracle : std::uint8_t {
  reference,  ///< the exact distribution, by an implementation that shares no code
  self,       ///< the sampler's own pdf
  mean,       ///< the exact mean of an estimator
  variance,   ///< the exact variance of an estimator
  check,      ///< a fact that needs no statistics
};

/// The name of an oracle: "reference", "self", "mean", "variance", "check".
std::string_view to_string(Oracle oracle);

/// A test of the gate. The order is that of tests().
enum class TestId : std::uint8_t {
  bins,
  texels,
  rows,
  columns,
  worst_texel,
  worst_row,
  worst_column,
  own_pdf_bins,
  phi,
  theta,
  transformed_pair,
  positions_first_row,
  positions_between,
  positions_last_row,
  independence_lag_1,
  independence_lag_2,
  independence_lag_4,
  independence_lag_8,
  independence_lag_16,
  independence_lag_32,
  independence_lag_64,
  run_sums_theta,
  run_sums_phi,
  irradiance_z_mean,
  irradiance_z_variance,
  irradiance_z_uniform,
  irradiance_x_mean,
  irradiance_x_variance,
  irradiance_x_uniform,
  inverse_pdf,
  two_samples,
  sequential,
  irradiance_z_constant,
  irradiance_x_constant,
  inverse_pdf_constant,
  in_domain,
  positive_density,
  random_bits,
  pdf_integral,
  pdf_support,
  declared_density,
  returned_pdf,
  next_to_one,
  edge_points,
  answers,
  same_texel,
  given_area,
  given_light,
  given_weights,
  light_reached,
  weight_is_light,
  grid_density,
  grid_integral,
  grid_bins,
};

template <>
inline constexpr std::size_t kValuesOf<Oracle> = 5;
template <>
inline constexpr std::size_t kValuesOf<TestId> = static_cast<std::size_t>(TestId::grid_bins) + 1;

/// What the effect of a test measures. Every one is 0 where nothing deviates.
enum class EffectMeasure : std::uint8_t {
  cells,            ///< w of Cohen: root mean square relative deviation of cells, by probability
  worst_cell,       ///< observed over expected count of the worst cell, less 1
  distance,         ///< distance of two distribution functions, as the statistic weighs it
  relative_mean,    ///< measured over exact value, less 1
  share,            ///< share of the samples, or of the points that were tried, that fail
  relative_pdf,     ///< largest relative difference of densities
  difference,       ///< relative difference of an integral from 1, or of a constant from its value
  unreachable_mass  ///< share of the light that the pdf calls unreachable
};

/// What an effect measures, in words: "the root mean square deviation of the cells …".
std::string_view meaning_of(EffectMeasure measure);

/// A row of the table of tests.
struct TestDescription {
  TestId id;
  Oracle oracle;
  std::string_view name;    ///< "texels"; unique with its oracle
  std::string_view counts;  ///< what the statistic is made of, in words
  /// Whether the p-value may be too large (never too small), as Bonferroni's over cells is.
  bool p_value_is_bound = false;
  EffectMeasure effect = EffectMeasure::cells;
};

/// All tests, in the order of TestId.
std::span<const TestDescription> tests();

/// The row of a test.
const TestDescription& describe(TestId test);

/// The name of a test with that of its oracle: "reference/texels".
std::string full_name(TestId test);

/// Whether a test is of all samples over the sphere, so that what it could have seen decides
/// whether an accepting run says anything: the bins, or all counts of a sequential run.
constexpr bool decides_power(TestId test) {
  return test == TestId::bins || test == TestId::sequential;
}

}  // namespace lightproof
