#include "lightproof/suite/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/suite/power_law.h"
#include "lightproof/suite/study.h"

namespace lightproof {
namespace {

std::vector<ConvergenceRecord> small_study(std::string_view name, std::uint64_t seed) {
  const EnvironmentMap map = make_synthetic_map(name, {64, 32});
  const std::vector<EnvironmentLight> lights(1, EnvironmentLight(map));
  return study_convergence(
      lights, {.seed = seed, .most_samples = 1024, .estimates = 64, .picture = {3, 2}});
}

TEST(Convergence, MeasuredErrorsAreThePredictedOnes) {
  // 32 lines of 6 independent points: the sum of squared deviations in standard errors. The
  // errors of squared errors are skewed, so the bound is Cantelli's, not the normal's: a line that
  // is off by 6 standard errors has probability below 1/37 for any law, and the slopes of all 32
  // lines average to -1/2 within 6 standard errors.
  double slope = 0.0;
  double weight = 0.0;
  for (const ConvergenceRecord& record : small_study("gradient", 1)) {
    ASSERT_EQ(record.points.size(), 6U);
    EXPECT_NEAR(record.measured_variance / record.predicted_variance, 1.0,
                6.0 * record.variance_ratio_error)
        << record.receiver << ", " << record.material << ", " << record.strategy;
    const double w = 1.0 / (record.slope_error * record.slope_error);
    slope += w * record.slope;
    weight += w;
  }
  EXPECT_NEAR(slope / weight, -0.5, 6.0 / std::sqrt(weight));
}

TEST(Convergence, AWrongVarianceWouldShow) {
  for (const ConvergenceRecord& record : small_study("gradient", 1)) {
    EXPECT_LT(record.variance_ratio_error, 0.15)
        << record.receiver << ", " << record.material << ", " << record.strategy;
  }
}

TEST(Convergence, CosineSamplingOfAConstantMapHasNoVariance) {
  int exact = 0;
  for (const ConvergenceRecord& record : small_study("constant", 1)) {
    if (record.material != "lambert" || record.strategy != "brdf") continue;
    if (record.receiver == "sphere-on-plane") continue;
    ++exact;
    EXPECT_TRUE(std::isnan(record.slope));
    for (const ConvergencePoint& point : record.points) EXPECT_LT(point.rmse, 1e-6);
  }
  EXPECT_EQ(exact, 3);
}

TEST(Convergence, TheSameBitsForAnyNumberOfThreads) {
  const auto study = [](int threads) {
    const ThreadLimit limit(threads);
    return small_study("gradient", 3);
  };
  const auto one = study(1);
  for (const int threads : {2, 7}) {
    const auto many = study(threads);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].measured_variance, many[i].measured_variance);
      EXPECT_EQ(one[i].points.back().rmse, many[i].points.back().rmse);
      EXPECT_EQ(one[i].predicted_variance, many[i].predicted_variance);
    }
  }
}

TEST(PowerLaw, FindsItsExponent) {
  const std::vector<PowerLawPoint> points = {{1, 3, 0.1}, {4, 1.5, 0.1}, {16, 0.75, 0.1}};
  const PowerLaw fit = fit_power_law(points);
  EXPECT_NEAR(fit.exponent, -0.5, 1e-12);
  EXPECT_NEAR(fit.constant, 3.0, 1e-12);
  // Var of the slope = sigma^2 / sum (x - mean)^2 = 0.01 / (2 ln^2 4).
  EXPECT_NEAR(fit.exponent_error, 0.1 / (std::sqrt(2.0) * std::log(4.0)), 1e-12);
}

TEST(DescribeMap, FiguresOfMapsWithClosedForms) {
  const MapRecord constant = describe_map(make_synthetic_map("constant", {64, 32}), 1);
  EXPECT_NEAR(constant.mean_luminance, 1.0, 1e-6);
  EXPECT_NEAR(constant.peak_ratio, 1.0, 1e-6);
  EXPECT_NEAR(constant.effective_fraction, 1.0, 1e-6);
  const MapRecord step = describe_map(make_synthetic_map("step", {64, 32}), 1);
  EXPECT_NEAR(step.effective_fraction, 0.5, 0.02);  // a texel of 32 rows on either side
  EXPECT_FALSE(step.drawn.empty());
}

}  // namespace
}  // namespace lightproof
