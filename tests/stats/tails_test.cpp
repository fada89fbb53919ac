#include "lightproof/stats/tails.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lightproof {
namespace {

constexpr long double kLn10 = 2.302585092994045684L;

/// log10 of exp(-y) sum_{k<m} y^k/k!, the tail for 2m degrees of freedom at 2y: in logarithms,
/// downwards from the last term, with 64 bits of precision.
long double log10_even_tail(double statistic, int dof) {
  const auto y = 0.5L * static_cast<long double>(statistic);
  const int last = dof / 2 - 1;
  long double term = 1.0L;
  long double sum = 1.0L;
  for (int k = last; k >= 1 && term > 1e-24L * sum; --k) {
    term *= static_cast<long double>(k) / y;
    sum += term;
  }
  const auto power = static_cast<long double>(last);
  return (-y + power * std::log(y) - std::lgamma(power + 1.0L) + std::log(sum)) / kLn10;
}

/// The statistic at which an even number of degrees of freedom has this tail.
double statistic_at(double log10_p, int dof) {
  double low = 0.5 * dof;
  double high = 2.0 * dof + 20000.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (log10_even_tail(middle, dof) > static_cast<long double>(log10_p) ? low : high) = middle;
  }
  return low;
}

/// What rounding does to -x + a log x - log Gamma(a), the leading part of every formula of the
/// tail: a few eps of its largest terms. And a few eps of the logarithm itself.
double rounding_of_tail(double statistic, double dof) {
  const double x = 0.5 * statistic;
  const double a = 0.5 * dof;
  const double terms = x + a * std::abs(std::log(x)) + std::abs(std::lgamma(a));
  return 4.0 * std::numeric_limits<double>::epsilon() * (terms + 1.0);
}

TEST(ChiSquareTail, OfTwoDegreesIsAnExponential) {
  for (const double x : {0.0, 1.386294361119891, 10.0, 600.0, 1380.0, 1385.0, 5000.0, 13815.6}) {
    const double exact = -0.5 * x / static_cast<double>(kLn10);
    EXPECT_NEAR(log10_chi_square_tail(x, 2.0), exact, 1e-15 + 4e-15 * std::abs(exact)) << x;
  }
}

TEST(ChiSquareTail, OfFourDegreesHasItsClosedForm) {
  for (const double x : {0.1, 3.356693980033321, 50.0, 1380.0, 1400.0, 13830.0}) {
    const double exact = (std::log1p(0.5 * x) - 0.5 * x) / static_cast<double>(kLn10);
    EXPECT_NEAR(log10_chi_square_tail(x, 4.0), exact, 1e-15 + 4e-15 * std::abs(exact)) << x;
  }
}

TEST(ChiSquareTail, AgreesWithTheFiniteSumDownToTenToTheMinus3000) {
  for (const int dof : {2, 4, 10, 32, 256, 1024, 16384, 65536, 1000000}) {
    for (const double log10_p : {-0.30103, -1.0, -6.0, -50.0, -299.0, -299.99, -300.01, -301.0,
                                 -307.0, -309.0, -323.0, -325.0, -1000.0, -3000.0}) {
      const double statistic = statistic_at(log10_p, dof);
      const auto exact = static_cast<double>(log10_even_tail(statistic, dof));
      ASSERT_NEAR(exact, log10_p, 1e-6) << "the statistic was not found";
      EXPECT_NEAR(log10_chi_square_tail(statistic, dof), exact, rounding_of_tail(statistic, dof))
          << dof << " degrees of freedom";
    }
  }
}

// Counts that agree exactly, or all but: P(a, x) = x^a e^-x / Gamma(a + 1) (1 + x/(a + 1) (1 + x/(a
// + 2) (1 + ...))), and the upper tail is 1.
TEST(ChiSquareLower, ReachesStatisticsNearZeroOfManyDegrees) {
  for (const double dof : {3400.0, 3600.0, 4095.0, 65535.0, 1e6}) {
    EXPECT_EQ(log10_chi_square_tail(0.0, dof), 0.0);
    for (const double statistic : {1e-12, 1e-9, 1e-6, 0.5, 2.0}) {
      const long double a = 0.5L * static_cast<long double>(dof);
      const long double x = 0.5L * static_cast<long double>(statistic);
      long double sum = 1.0L;
      for (int k = 8; k >= 1; --k) sum = 1.0L + x / (a + static_cast<long double>(k)) * sum;
      const long double exact =
          (a * std::log(x) - x - std::lgamma(a + 1.0L) + std::log(sum)) / kLn10;
      EXPECT_NEAR(log10_chi_square_lower(statistic, dof), static_cast<double>(exact),
                  rounding_of_tail(statistic, dof));
      EXPECT_EQ(log10_chi_square_tail(statistic, dof), 0.0);
    }
  }
}

TEST(ChiSquareTail, AgreesWithBoostNearTheCentreOfAMillionDegrees) {
  const boost::math::chi_squared million(1e6);
  for (const double deviations : {-6.0, -3.0, 0.0, 1.0, 5.0, 9.0}) {
    const double statistic = 1e6 + deviations * std::sqrt(2e6);
    const double p = boost::math::cdf(boost::math::complement(million, statistic));
    EXPECT_NEAR(log10_chi_square_tail(statistic, 1e6), std::log10(p), 1e-12);
  }
}

TEST(ChiSquareTail, FallsWithoutAStepWhereDoublesEnd) {
  for (const double dof : {1.0, 31.0, 1023.0, 65535.0}) {
    double before = 0.0;
    for (int i = 0; i <= 4000; ++i) {
      const double now = log10_chi_square_tail(dof + i * std::sqrt(2.0 * dof) * 0.05, dof);
      EXPECT_LE(now, before);
      // A step in the slope: one twentieth of a standard deviation is never worth a factor 10^8.
      EXPECT_GT(now, before - 8.0);
      before = now;
    }
  }
}

TEST(ChiSquareTail, OfTheExtremes) {
  EXPECT_EQ(log10_chi_square_tail(0.0, 7.0), 0.0);
  EXPECT_EQ(log10_chi_square_tail(INFINITY, 7.0), -INFINITY);
  EXPECT_GT(log10_chi_square_tail(1e9, 7.0), -INFINITY) << "finite statistics have finite tails";
}

TEST(NormalTails, AreTwoSidedAndSymmetric) {
  EXPECT_EQ(log10_normal_tails(0.0), 0.0);
  for (const double z : {0.5, 3.0, 40.0}) EXPECT_EQ(log10_normal_tails(z), log10_normal_tails(-z));
  EXPECT_EQ(log10_normal_tails(INFINITY), -INFINITY);
  EXPECT_EQ(log10_normal_tails(-INFINITY), -INFINITY);
}

TEST(NormalTails, HaveTheStandardQuantiles) {
  // The quantiles are rounded to 1e-15; the slope of log10 p is below 3 there.
  const std::pair<double, double> quantiles[] = {{0.674489750196082, 0.5},
                                                 {1.959963984540054, 0.05},
                                                 {2.575829303548901, 0.01},
                                                 {3.290526731491895, 0.001},
                                                 {4.891638475698590, 1e-6}};
  for (const auto& [z, p] : quantiles) {
    EXPECT_NEAR(log10_normal_tails(z), std::log10(p), 1e-14) << z;
  }
}

TEST(NormalTails, FollowTheAsymptoticSeriesFarOut) {
  for (const double z : {30.0, 37.0, 38.0, 40.0, 100.0}) {
    const double w = 1.0 / (z * z);
    // The series alternates: its error is below the first term left out, 945 w^5 < 2e-12.
    const double series = -w * (1.0 - w * (3.0 - w * (15.0 - w * 105.0)));
    const double log_density = -0.5 * z * z - 0.5 * std::log(2.0 * std::acos(-1.0));
    const double exact =
        (log_density + std::log(2.0 / z) + std::log1p(series)) / static_cast<double>(kLn10);
    EXPECT_NEAR(log10_normal_tails(z), exact, 945.0 * std::pow(w, 5) + rounding_of_tail(z * z, 1.0))
        << z;
  }
}

TEST(Detectable, NoncentralityIsThatOfTheTable) {
  // alpha = 1e-6 at power .99; half a unit of the last digit printed.
  struct Row {
    double dof;
    double lambda;
    double half_digit;
  };
  constexpr Row kTable[] = {{1, 52.1, 0.05},   {31, 97.9, 0.05}, {199, 184, 0.5},
                            {1023, 364, 0.5},  {5049, 755, 0.5}, {16383, 1326, 0.5},
                            {65535, 2607, 0.5}};
  for (const Row& row : kTable) {
    EXPECT_NEAR(minimum_detectable_noncentrality(row.dof, 1e-6, 0.99), row.lambda, row.half_digit)
        << row.dof;
  }
}

TEST(Detectable, NoncentralityGrowsWithPowerAndStrictness) {
  EXPECT_GT(minimum_detectable_noncentrality(31, 1e-6, 0.99),
            minimum_detectable_noncentrality(31, 1e-6, 0.9));
  EXPECT_GT(minimum_detectable_noncentrality(31, 1e-8, 0.99),
            minimum_detectable_noncentrality(31, 1e-6, 0.99));
}

TEST(Detectable, ZIsTheSumOfTwoQuantiles) {
  EXPECT_NEAR(minimum_detectable_z(0.05, 0.8), 1.959963984540054 + 0.841621233572914, 1e-13);
  EXPECT_NEAR(minimum_detectable_z(1e-6, 0.99), 4.891638475698590 + 2.326347874040841, 1e-13);
}

TEST(StudentUpper, OfOneAndTwoDegreesHasItsClosedForm) {
  for (const double t : {-1.5, 0.0, 0.3, 2.0, 12.7, 318.3}) {
    EXPECT_NEAR(student_upper(t, 1.0), 0.5 - std::atan(t) / std::numbers::pi, 1e-15) << t;
    EXPECT_NEAR(student_upper(t, 2.0), 0.5 * (1.0 - t / std::sqrt(2.0 + t * t)), 1e-15) << t;
  }
  EXPECT_EQ(student_upper(std::numeric_limits<double>::infinity(), 3.0), 0.0);
}

TEST(Detectable, ZIsTheRootOfTheNoncentralityOfOneDegree) {
  // They differ by the rejections in the other tail: P(Z < -12) = 1e-33.
  const double z = minimum_detectable_z(1e-6, 0.99);
  EXPECT_NEAR(minimum_detectable_noncentrality(1, 1e-6, 0.99), z * z, 1e-6);
}

}  // namespace
}  // namespace lightproof
