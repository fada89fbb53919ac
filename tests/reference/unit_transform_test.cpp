#include "reference/unit_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

// Rows of grey 1 1 and 3 1: under A they weigh 1 : 2, in the columns 4 : 2.
UnitTransform transform_of(Weighting weighting) {
  return UnitTransform(texel_masses(grey_map({2, 2}, {1, 1, 3, 1}), {weighting}), weighting);
}

TEST(UnitTransform, IsLinearInsideATexelUnderA) {
  const UnitTransform transform = transform_of(Weighting::A);
  // A quarter up the lower row, half across its second texel.
  const UnitPoint low = transform({0.75, 0.125}, 1, 0);
  EXPECT_NEAR(low.along, 0.25 / 3.0, 1e-15);
  EXPECT_NEAR(low.across, 0.75, 1e-15);
  EXPECT_NEAR(low.column, 4.0 / 6.0 + 0.5 * 2.0 / 6.0, 1e-15);
  // Three quarters up the upper row, a tenth across its first texel, which holds 3/4 of it.
  const UnitPoint high = transform({0.05, 0.875}, 0, 1);
  EXPECT_NEAR(high.along, 1.0 / 3.0 + 0.75 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(high.across, 0.075, 1e-15);
  EXPECT_NEAR(high.column, 0.1 * 4.0 / 6.0, 1e-15);
}

// Both rows have the same solid angle, in which the place is linear: cos(theta) = -cos(pi t).
TEST(UnitTransform, IsLinearInTheCosineUnderB) {
  const UnitTransform transform = transform_of(Weighting::B);
  const double t = 1.0 / 3.0;  // cos(theta) = -1/2, half of the lower row's solid angle
  EXPECT_NEAR(transform({0.75, t}, 1, 0).along, 0.5 / 3.0, 1e-15);
  EXPECT_NEAR(transform({0.25, 2.0 / 3.0}, 0, 1).along, 1.0 / 3.0 + 0.5 * 2.0 / 3.0, 1e-15);
}

TEST(UnitTransform, TakesTheUnitSquareToTheUnitSquare) {
  for (const Weighting weighting : {Weighting::A, Weighting::B}) {
    const UnitTransform transform = transform_of(weighting);
    const UnitPoint low = transform({0.0, 0.0}, 0, 0);
    EXPECT_EQ(low.along, 0.0);
    EXPECT_EQ(low.across, 0.0);
    EXPECT_EQ(low.column, 0.0);
    const UnitPoint high = transform({1.0, 1.0}, 1, 1);
    EXPECT_NEAR(high.along, 1.0, 1e-15);
    EXPECT_NEAR(high.across, 1.0, 1e-15);
    EXPECT_NEAR(high.column, 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace lightproof::reference
