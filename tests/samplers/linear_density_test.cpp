#include "lightproof/samplers/linear_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/measure.h"

namespace lightproof {
namespace {

constexpr double kEnds[][2] = {{1.0, 1.0}, {0.0, 2.0},   {2.0, 0.0}, {1.0, 1e5},
                               {1e5, 1.0}, {0.0, 1e-30}, {1e30, 1.0}};

// Its three terms and the root round a few times each.
TEST(InvertLinear, LeavesTheShareBelow) {
  for (const auto [low, high] : kEnds) {
    for (int i = 0; i <= 1000; ++i) {
      const double u = i / 1000.0;
      const double x = invert_linear(low, high, u);
      const double below = x * (low + 0.5 * (high - low) * x) / (0.5 * (low + high));
      ASSERT_NEAR(below, u, 8.0 * 0x1p-52) << low << ", " << high;
    }
  }
}

TEST(InvertLinear, EndsAtTheEnds) {
  for (const auto [low, high] : kEnds) {
    EXPECT_EQ(invert_linear(low, high, 0.0), 0.0);
    EXPECT_NEAR(invert_linear(low, high, 1.0), 1.0, 2.0 * 0x1p-52);
  }
}

// sin(pi q / 2): ∫ = 2/pi, ∫ q = 4/pi^2 over [0,1]. The series are cut off below 1e-17.
TEST(LinearTimesSine, IntegralsOfAQuarterTurn) {
  const LinearTimesSine sine(0.0, 0.5 * kPi);
  EXPECT_NEAR(sine.integral(1.0, 1.0, 1.0), 2.0 / kPi, 4.0 * 0x1p-53);
  EXPECT_NEAR(sine.integral(0.0, 1.0, 1.0), 4.0 / (kPi * kPi), 4.0 * 0x1p-53);
  EXPECT_NEAR(sine.integral(1.0, 0.0, 1.0), 2.0 / kPi - 4.0 / (kPi * kPi), 4.0 * 0x1p-53);
  // ∫ from 0 to q of q' sin(pi q'/2): primitive 4/pi^2 sin(pi q/2) - 2q/pi cos(pi q/2).
  for (const double q : {0.1, 0.5, 0.9}) {
    const double z = 0.5 * kPi * q;
    EXPECT_NEAR(sine.integral(0.0, 1.0, q),
                4.0 / (kPi * kPi) * std::sin(z) - 2.0 * q / kPi * std::cos(z), 8.0 * 0x1p-53);
  }
}

// In powers of the step, of which the fourth is below 1e-20.
TEST(LinearTimesSine, NothingCancelsInANarrowRow) {
  constexpr double kStep = 1e-5;
  for (const double angle : {0.0, 0.3, 1.5}) {
    const LinearTimesSine sine(angle, kStep);
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const double rising = s / 2.0 + kStep * (c / 3.0 - kStep * (s / 8.0 + kStep * c / 30.0));
    const double falling = s / 2.0 + kStep * (c / 6.0 - kStep * (s / 24.0 + kStep * c / 120.0));
    EXPECT_NEAR(sine.integral(0.0, 1.0, 1.0), rising, 4.0 * 0x1p-52 * rising);
    EXPECT_NEAR(sine.integral(1.0, 0.0, 1.0), falling, 4.0 * 0x1p-52 * falling);
  }
}

// Newton's last step leaves a share of 2^-60 of q where the density rises from 0, less elsewhere;
// both integrals round.
TEST(LinearTimesSine, LeavesTheShareBelow) {
  for (const double step : {1e-4, 0.1, 0.5 * kPi}) {
    for (const double angle : {0.0, 0.7}) {
      const LinearTimesSine sine(angle, step);
      for (const auto [low, high] : kEnds) {
        const double whole = sine.integral(low, high, 1.0);
        double last = 0.0;
        for (int i = 1; i < 1000; ++i) {
          const double u = i / 1000.0;
          const double q = sine.invert(low, high, u);
          ASSERT_GT(q, last) << low << ", " << high;
          ASSERT_LT(q, 1.0);
          ASSERT_NEAR(sine.integral(low, high, q) / whole, u, 16.0 * 0x1p-52)
              << low << ", " << high << ", " << step;
          last = q;
        }
      }
    }
  }
}

// Where both factors rise from 0 the share below q is q^3: 2^-60 lies at 2^-20. Where one falls to
// 0 it is (1-q)^2 that is left above.
TEST(LinearTimesSine, TakesTheLeastAndTheLargestShares) {
  const LinearTimesSine sine(0.0, 1e-3);
  for (const auto [low, high] : kEnds) {
    for (const double u : {0.0, 0x1p-60, 0x1p-31, 1.0 - 0x1p-31, 1.0 - 0x1p-53, 1.0}) {
      const double q = sine.invert(low, high, u);
      EXPECT_TRUE(q >= 0.0 && q <= 1.0) << low << ", " << high << ", " << u << ": " << q;
    }
    EXPECT_LT(sine.invert(low, high, 0x1p-60), 1.001 * 0x1p-20);
    EXPECT_GT(sine.invert(low, high, 1.0 - 0x1p-53), 1.0 - 0x1p-25);
  }
}

}  // namespace
}  // namespace lightproof
