#include "lightproof/core/measure.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace lightproof {
namespace {

TEST(Measure, SineIsExactlyZeroAtBothPoles) {
  EXPECT_EQ(sin_theta(0.0), 0.0);
  EXPECT_EQ(sin_theta(1.0), 0.0);
  EXPECT_EQ(solid_angle_per_square(0.0), 0.0);
  EXPECT_EQ(solid_angle_per_square(1.0), 0.0);
}

TEST(Measure, SineIsTheSameFromBothPoles) {
  for (int i = 0; i <= 4096; ++i) {
    const double t = i / 4096.0;  // so that 1 - t is exact
    EXPECT_EQ(sin_theta(t), sin_theta(1.0 - t)) << t;
  }
}

TEST(Measure, SineAndCosineAreThoseOfTheAngle) {
  EXPECT_EQ(sin_theta(0.5), 1.0);
  EXPECT_EQ(cos_theta(0.0), -1.0);
  EXPECT_EQ(cos_theta(1.0), 1.0);
  // pi rounded: half an ulp of pi at most, and the rounding of the function.
  EXPECT_NEAR(cos_theta(0.5), 0.0, 2.5e-16);
  EXPECT_NEAR(sin_theta(1.0 / 6.0), 0.5, 2.5e-16);
  EXPECT_NEAR(cos_theta(1.0 / 3.0), -0.5, 5e-16);
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    EXPECT_NEAR(std::hypot(sin_theta(t), cos_theta(t)), 1.0, 5e-16) << t;
  }
}

TEST(Measure, SineKeepsItsDigitsNextToAPole) {
  // sin x = x to a relative x^2/6; 1 - 0x1p-40 is a double, and so is its distance from the pole.
  EXPECT_DOUBLE_EQ(sin_theta(0x1p-40), kPi * 0x1p-40);
  EXPECT_DOUBLE_EQ(sin_theta(1.0 - 0x1p-40), kPi * 0x1p-40);
}

TEST(Measure, JacobianIsTwoPiSquaredAtTheHorizon) {
  EXPECT_DOUBLE_EQ(solid_angle_per_square(0.5), 2.0 * kPi * kPi);
  EXPECT_DOUBLE_EQ(solid_angle_per_square(1.0 / 6.0), kPi * kPi);
}

TEST(Measure, DensityConvertsToSolidAngleAndBack) {
  // Two roundings of half an ulp each: EXPECT_DOUBLE_EQ allows four ulp.
  for (const double t : std::array{0x1p-52, 1e-9, 0.001, 0.25, 0.5, 0.75, 0.999, 1.0 - 0x1p-53}) {
    const SquarePoint at = {0.3, t};
    for (const double p : std::array{1e-30, 1.0, 7.5, 1e30}) {
      EXPECT_DOUBLE_EQ(to_square(to_solid_angle({p}, at), at).value, p) << t;
      EXPECT_DOUBLE_EQ(to_solid_angle(to_square({p}, at), at).value, p) << t;
    }
  }
}

TEST(Measure, UniformDirectionsAreDenserOverTheSquareAtTheHorizon) {
  EXPECT_DOUBLE_EQ(to_square({1.0 / kSphere}, {0.0, 0.5}).value, 0.5 * kPi);
  EXPECT_DOUBLE_EQ(to_solid_angle({1.0}, {0.0, 0.5}).value, 1.0 / (2.0 * kPi * kPi));
}

TEST(Measure, PolesHaveTheirLimits) {
  for (const double pole : {0.0, 1.0}) {
    EXPECT_EQ(to_square({3.0}, {0.2, pole}).value, 0.0);
    EXPECT_EQ(to_solid_angle({3.0}, {0.2, pole}).value, INFINITY);
  }
}

}  // namespace
}  // namespace lightproof
