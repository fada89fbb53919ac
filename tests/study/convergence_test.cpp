#include "lightproof/study/convergence.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/stats/power_law.h"
#include "lightproof/study/study.h"

namespace lightproof {
namespace {

std::vector<ConvergenceRecord> small_study(std::string_view name, std::uint64_t seed) {
  const EnvironmentMap map = make_synthetic_map(name, {64, 32});
  return study_convergence(
      {&map, 1}, {.seed = seed, .most_samples = 1024, .estimates = 64, .picture = {3, 2}});
}

// Measured squared errors are means of squares: skewed to the right, so a single one is judged at 8
// standard errors. Their mean squared deviation over all points must be 1: the points number 100
// and more, each with a variance of z^2 of 2 + excess kurtosis, which is below 30 where the
// standard error is at most a sixth; 6 standard errors of the mean, sqrt(32/100) each, are then
// below 3.4.
TEST(Convergence, MeasuredErrorsAreThePredictedOnes) {
  int points = 0;
  double squares = 0.0;
  for (const ConvergenceRecord& record : small_study("gradient", 1)) {
    for (const ConvergencePoint& point : record.points) {
      if (!(point.rmse_error > 0.0 && point.rmse_error <= point.predicted / 6.0)) continue;
      const double z = (point.rmse - point.predicted) / point.rmse_error;
      EXPECT_LT(std::abs(z), 8.0) << record.receiver << ", " << record.material << ", "
                                  << record.estimator << ", N = " << point.samples;
      squares += z * z;
      ++points;
    }
  }
  EXPECT_GT(points, 100);
  EXPECT_LT(squares / points, 1.0 + 3.4);
}

// A variance's ratio is judged at 6 of its standard errors; so is the slope of all lines together.
// A narrow lobe that is found by rare hits has no slope: too few of its errors can be measured with
// so few estimates.
TEST(Convergence, VariancesAndSlopesAreThePredictedOnes) {
  double slope = 0.0;
  double weight = 0.0;
  int lines = 0;
  for (const ConvergenceRecord& record : small_study("gradient", 1)) {
    ASSERT_EQ(record.points.size(), 6U);
    EXPECT_NEAR(record.measured_variance / record.predicted_variance, 1.0,
                6.0 * record.variance_ratio_error)
        << record.receiver << ", " << record.material << ", " << record.estimator;
    if (std::isnan(record.slope)) continue;
    const double w = 1.0 / (record.slope_error * record.slope_error);
    slope += w * record.slope;
    weight += w;
    ++lines;
  }
  EXPECT_GE(lines, 32);
  EXPECT_NEAR(slope / weight, -0.5, 6.0 / std::sqrt(weight));
}

TEST(Convergence, AWrongVarianceWouldShow) {
  for (const ConvergenceRecord& record : small_study("gradient", 1)) {
    EXPECT_LT(record.variance_ratio_error, 0.15)
        << record.receiver << ", " << record.material << ", " << record.estimator;
  }
}

TEST(Convergence, CosineSamplingOfAConstantMapHasNoVariance) {
  int exact = 0;
  for (const ConvergenceRecord& record : small_study("constant", 1)) {
    if (record.material != "lambert" || record.estimator != "brdf") continue;
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
      EXPECT_EQ(one[i].predicted_variance, many[i].predicted_variance);
      EXPECT_EQ(one[i].variance_ratio_error, many[i].variance_ratio_error);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(one[i].slope),
                std::bit_cast<std::uint64_t>(many[i].slope));
      ASSERT_EQ(one[i].points.size(), many[i].points.size());
      for (std::size_t k = 0; k < one[i].points.size(); ++k) {
        EXPECT_EQ(one[i].points[k].rmse, many[i].points[k].rmse);
        EXPECT_EQ(one[i].points[k].rmse_error, many[i].points[k].rmse_error);
        EXPECT_EQ(one[i].points[k].predicted, many[i].points[k].predicted);
      }
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
