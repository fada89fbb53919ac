#include "lightproof/gate/estimator_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lightproof/stats/moment_tests.h"

namespace lightproof {
namespace {

/// Below this share of the mean square the fourth central moment drowns in rounding, and there is
/// no test of the variance.
constexpr double kTestableVariance = 1e-5;

/// The largest value at the nodes of the quadrature, with room for what lies between them.
ExactMoments exact_moments(const reference::EstimatorMoments& exact) {
  const double largest = 1.1 * exact.largest;
  return {exact.mean(), exact.variance(), std::max(largest - exact.mean(), exact.mean())};
}

/// The moments of an estimator that would be one value everywhere but for the sampler's
/// rounding of densities, which it declares: it is unbiased all the same. None if there is no such
/// rounding, or more of it than is declared.
std::optional<ExactMoments> moments_of_rounding(const reference::EstimatorMoments& exact,
                                                const DensityComparison& density) {
  constexpr double kNoRounding = 1e-12;
  if (density.cells_off > 0 || density.rounding_variance <= kNoRounding) return std::nullopt;
  return ExactMoments{exact.mean(), exact.mean() * exact.mean() * density.rounding_variance,
                      exact.mean() * std::max(1.0, density.largest_weight_error)};
}

/// The tests of one estimator.
struct MomentTests {
  TestId mean;
  std::optional<TestId> variance;
  TestId constant;
};

/// The tests of the estimators of kMeanCases.
struct MeanCaseTests {
  MomentTests moments;
  TestId against_uniform;
};
constexpr std::array<MeanCaseTests, kMeanCaseCount> kMeanCaseTests = {{
    {{TestId::irradiance_z_mean, TestId::irradiance_z_variance, TestId::irradiance_z_constant},
     TestId::irradiance_z_uniform},
    {{TestId::irradiance_x_mean, TestId::irradiance_x_variance, TestId::irradiance_x_constant},
     TestId::irradiance_x_uniform},
}};
constexpr MomentTests kInversePdfTests = {TestId::inverse_pdf, std::nullopt,
                                          TestId::inverse_pdf_constant};

/// Mean and variance of an estimator; one whose exact variance is only rounding is compared with
/// its constant instead.
void add_moments(Records& records, const MomentTests& tests, const Moments& measured,
                 const reference::EstimatorMoments& exact, const DensityComparison& density) {
  if (exact.mean() <= 0.0) return;  // no light reaches this case
  if (measured.count() < 2) {
    records.add(tests.mean).record.detail = "no sample stayed on the map";
    return;
  }
  if (exact.variance() <= 1e-12 * exact.raw[1]) {
    if (const auto moments = moments_of_rounding(exact, density)) {
      records.add_z(tests.mean, mean_test(measured, *moments), *moments, exact.mean());
      return;
    }
    const double error = std::abs(measured.mean() / exact.mean() - 1.0);
    records.add_check({tests.constant, error <= 1e-6, error, ""});
    return;
  }
  const ExactMoments moments = exact_moments(exact);
  records.add_z(tests.mean, mean_test(measured, moments), moments, exact.mean());
  if (!tests.variance || exact.variance() <= kTestableVariance * exact.raw[1]) return;
  records.add_z(*tests.variance, variance_test(measured, moments, exact.fourth_central()),
                moments_of_squares(moments, exact.fourth_central()), exact.variance());
}

/// The sampler's estimate against that of uniform directions, which has errors of its own.
void add_against_uniform(Records& records, TestId test, const Moments& sampled,
                         const reference::EstimatorMoments& exact, const Moments& uniform,
                         const reference::EstimatorMoments& exact_uniform) {
  if (exact.mean() <= 0.0 || sampled.count() < 2 || exact_uniform.variance() <= 0.0) return;
  const ExactMoments moments = exact_moments(exact);
  const ExactMoments uniform_moments = exact_moments(exact_uniform);
  records.add_z(test, two_mean_test(sampled, moments, uniform, uniform_moments),
                moments_of_difference(moments, uniform_moments, 1.0), exact_uniform.mean());
}

void add_not_run(Records& records) {
  for (const auto& [moments, against_uniform] : kMeanCaseTests) {
    records.add_not_run(moments.mean, kNoWeights);
    records.add_not_run(*moments.variance, kNoWeights);
    records.add_not_run(against_uniform, kNoWeights);
  }
  records.add_not_run(kInversePdfTests.mean, kNoWeights);
}

}  // namespace

void add_estimators(Records& records, const Expectation& expectation, const Inspection& inspection,
                    const Draws& draws, const UniformEstimates& uniform) {
  if (!inspection.has_weights) return add_not_run(records);
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const auto& [moments, against_uniform] = kMeanCaseTests[i];
    records.attempt(moments.mean, [&, &moments = moments, &against_uniform = against_uniform] {
      add_moments(records, moments, draws.estimators[i], expectation.estimators[i],
                  inspection.density);
      add_against_uniform(records, against_uniform, draws.estimators[i], expectation.estimators[i],
                          uniform[i], expectation.uniform[i]);
    });
  }
  records.attempt(kInversePdfTests.mean, [&] {
    add_moments(records, kInversePdfTests, draws.inverse_pdf, expectation.inverse_pdf,
                inspection.density);
  });
}

}  // namespace lightproof
