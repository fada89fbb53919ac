#include "lightproof/stats/median.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

/// The standard deviation of the median over all 5^5 samples of five values, with replacement.
double enumerated_error(const std::vector<double>& values) {
  double sum = 0.0;
  double square = 0.0;
  for (int code = 0; code < 3125; ++code) {
    std::vector<double> sample;
    for (int rest = code, i = 0; i < 5; ++i, rest /= 5) {
      sample.push_back(values[static_cast<std::size_t>(rest % 5)]);
    }
    const double m = median(sample);
    sum += m / 3125.0;
    square += m * m / 3125.0;
  }
  return std::sqrt(square - sum * sum);
}

TEST(MedianError, IsThatOfAllSamplesOfTheValues) {
  const std::vector<double> values = {1.0, 1.5, 3.0, 3.25, 9.0};
  // The enumeration adds 3125 squares up to 81: 3125 eps 81 / (2 * 1.7).
  EXPECT_NEAR(median_error(values), enumerated_error(values), 2e-11);
}

TEST(MedianError, FeelsNoShiftAndScalesWithTheValues) {
  const double error = median_error({1.0, 2.0, 4.0, 7.0, 7.5, 9.0});
  EXPECT_NEAR(median_error({1e6 + 1, 1e6 + 2, 1e6 + 4, 1e6 + 7, 1e6 + 7.5, 1e6 + 9}), error, 1e-9);
  EXPECT_NEAR(median_error({10, 20, 40, 70, 75, 90}), 10.0 * error, 1e-13);
}

TEST(MedianError, OfOneValueOrEqualOnesIsZero) {
  EXPECT_EQ(median_error({}), 0.0);
  EXPECT_EQ(median_error({5.0}), 0.0);
  EXPECT_EQ(median_error({5.0, 5.0, 5.0}), 0.0);
}

}  // namespace
}  // namespace lightproof
