#include "lightproof/stats/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lightproof {
namespace {

constexpr double kError = 0.05;

/// Points of 3 x^(-1/2) whose logarithms are off by so many of their standard errors.
std::vector<PowerLawPoint> points_off_by(const std::vector<double>& errors) {
  std::vector<PowerLawPoint> points;
  double x = 1.0;
  for (const double off : errors) {
    points.push_back({x, 3.0 / std::sqrt(x) * std::exp(off * kError), kError});
    x *= 4.0;
  }
  return points;
}

TEST(PowerLaw, ThroughPointsOnOneHasNoScatter) {
  const std::vector<PowerLawPoint> points = points_off_by({0, 0, 0, 0, 0});
  const PowerLaw fit = fit_power_law(points);
  EXPECT_NEAR(fit.exponent, -0.5, 1e-14);
  EXPECT_NEAR(fit.constant, 3.0, 1e-13);
  EXPECT_NEAR(scatter_about(fit, points), 0.0, 1e-12);
  EXPECT_EQ(exponent_error_with_scatter(fit, points), fit.exponent_error);
}

// Errors of 3, -6, 3 beside equal x are orthogonal to every straight line: the fit is that of no
// errors, and chi square 54 with one degree of freedom.
TEST(PowerLaw, IsAsUncertainAsItsPointsScatter) {
  const std::vector<PowerLawPoint> points = points_off_by({3, -6, 3});
  const PowerLaw fit = fit_power_law(points);
  EXPECT_NEAR(fit.exponent, -0.5, 1e-13);
  EXPECT_NEAR(scatter_about(fit, points), std::sqrt(54.0), 1e-10);
  EXPECT_NEAR(exponent_error_with_scatter(fit, points), std::sqrt(54.0) * fit.exponent_error,
              1e-12);
}

}  // namespace
}  // namespace lightproof
