#include "lightproof/stats/critical_value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// What critical_value promises, with one more rounding of the excess.
constexpr double kRelativeError = 0x1p-48;

// Of P(X >= x) = exp(-x / scale): x = -scale log(level), from far below the first guess to far
// above it.
TEST(CriticalValue, IsThatOfAnExponentialDistribution) {
  for (const double scale : {1e-12, 1e-3, 1.0, 7.0, 1e3, 1e12}) {
    for (const double log10_level : {-1e-3, -3.0, -6.0, -300.0}) {
      const auto log10_tail = [&](double x) { return -x / scale * std::numbers::log10e; };
      const double exact = -log10_level * scale * std::numbers::ln10;
      EXPECT_NEAR(critical_value(log10_tail, log10_level) / exact, 1.0, kRelativeError)
          << scale << ", " << log10_level;
    }
  }
}

TEST(CriticalValue, IsTheQuantileOfANormal) {
  // Two-sided 5 % and 1e-6 (Abramowitz & Stegun, tables 26.5 and 26.6), to the digits given there.
  EXPECT_NEAR(critical_value(log10_normal_tails, std::log10(0.05)), 1.95996, 5e-6);
  EXPECT_NEAR(critical_value(log10_normal_tails, -6.0), 4.89164, 5e-6);
}

// On the far side of the jump, where the tail is below the level.
TEST(CriticalValue, StandsWhereATailJumpsOverTheLevel) {
  for (const double jump : {0.01, 3.0, 5000.0}) {
    const auto log10_tail = [&](double x) { return x < jump ? -2.0 : -9.0; };
    const double found = critical_value(log10_tail, -6.0);
    EXPECT_GE(found, jump);
    EXPECT_LE(found, jump * (1.0 + kRelativeError));
  }
}

TEST(CriticalValue, IsZeroIfEverythingIsBelowTheLevel) {
  EXPECT_EQ(critical_value([](double x) { return -x; }, 0.0), 0.0);
  EXPECT_EQ(critical_value([](double x) { return -7.0 - x; }, -6.0), 0.0);
}

}  // namespace
}  // namespace lightproof
