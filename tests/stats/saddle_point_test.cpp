#include "lightproof/stats/saddle_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace lightproof {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(StirlingRemainder, IsWhatStirlingsFormulaLacks) {
  // In long double, up to where its own cancellation reaches an eps of a double. Below 10 the
  // remainder is a difference of terms of up to 20.
  constexpr long double kPi = std::numbers::pi_v<long double>;
  for (const double z : {1e-9, 1e-3, 0.25, 0.5, 1.0, 1.5, 3.7, 9.999, 10.0, 10.5, 31.0, 200.0}) {
    const auto x = static_cast<long double>(z);
    const long double exact =
        std::lgamma(x) - ((x - 0.5L) * std::log(x) - x + 0.5L * std::log(2.0L * kPi));
    EXPECT_NEAR(stirling_remainder(z), static_cast<double>(exact), 20.0 * 4.0 * kEps) << z;
  }
  // The first term, 1 / (12 z), is all of it.
  EXPECT_NEAR(stirling_remainder(1e12) * 12e12, 1.0, 4.0 * kEps);
}

TEST(HalfDeviance, HasNoCancellationNearZero) {
  for (const double expected : {1e-6, 3.0, 1e9}) {
    for (const double u : {1e-12, -1e-6, 0.01, -0.1, 0.18, 0.22, 0.25, -0.19, -0.5, 3.0, 1e6}) {
      const double observed = expected * (1.0 + u);
      const auto o = static_cast<long double>(observed);
      const auto e = static_cast<long double>(expected);
      const long double v = (e - o) / o;
      // o (v - log(1 + v)), by its series where that is small.
      long double exact = v - std::log1p(v);
      if (std::abs(v) < 0.02L) {
        exact = 0.0L;
        long double power = v;
        for (int k = 2; k < 16; ++k) exact += (power *= -v) / static_cast<long double>(-k);
      }
      EXPECT_NEAR(half_deviance(observed, expected) / static_cast<double>(o * exact), 1.0,
                  40.0 * kEps)
          << observed << " of " << expected;
    }
  }
  EXPECT_EQ(half_deviance(7.0, 7.0), 0.0);
}

TEST(HalfDeviance, TakesTheDifferenceOfTheCaller) {
  // 2^53 + 1 is no double: the caller's difference is not lost.
  const double large = 0x1p53;
  EXPECT_NEAR(half_deviance(large, large, 1.0) * 2.0 * large, 1.0, 1e-12);
}

}  // namespace
}  // namespace lightproof
