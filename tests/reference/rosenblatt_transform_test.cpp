#include "reference/rosenblatt_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

// Rows of luminance 1 1 and 3 1: under A they weigh 1 : 2, in the columns 4 : 2.
RosenblattTransform transform_of(DensitySpace density_space) {
  return RosenblattTransform(texel_masses(grey_map({2, 2}, {1, 1, 3, 1}), {density_space}),
                             density_space);
}

TEST(RosenblattTransform, IsLinearInsideATexelUnderA) {
  const RosenblattTransform transform = transform_of(DensitySpace::texture);
  // A quarter up the lower row, half across its second texel.
  const RosenblattPoint low = transform({0.75, 0.125}, 1, 0);
  EXPECT_NEAR(low.marginal, 0.25 / 3.0, 1e-15);
  EXPECT_NEAR(low.conditional, 0.75, 1e-15);
  EXPECT_NEAR(low.column_marginal, 4.0 / 6.0 + 0.5 * 2.0 / 6.0, 1e-15);
  // Three quarters up the upper row, a tenth across its first texel, which holds 3/4 of it.
  const RosenblattPoint high = transform({0.05, 0.875}, 0, 1);
  EXPECT_NEAR(high.marginal, 1.0 / 3.0 + 0.75 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(high.conditional, 0.075, 1e-15);
  EXPECT_NEAR(high.column_marginal, 0.1 * 4.0 / 6.0, 1e-15);
}

// Both rows have the same solid angle, in which the place is linear: cos(theta) = -cos(pi t).
TEST(RosenblattTransform, IsLinearInTheCosineUnderB) {
  const RosenblattTransform transform = transform_of(DensitySpace::solid_angle);
  const double t = 1.0 / 3.0;  // cos(theta) = -1/2, half of the lower row's solid angle
  EXPECT_NEAR(transform({0.75, t}, 1, 0).marginal, 0.5 / 3.0, 1e-15);
  EXPECT_NEAR(transform({0.25, 2.0 / 3.0}, 0, 1).marginal, 1.0 / 3.0 + 0.5 * 2.0 / 3.0, 1e-15);
}

TEST(RosenblattTransform, TakesTheUnitSquareToTheUnitSquare) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const RosenblattTransform transform = transform_of(density_space);
    const RosenblattPoint low = transform({0.0, 0.0}, 0, 0);
    EXPECT_EQ(low.marginal, 0.0);
    EXPECT_EQ(low.conditional, 0.0);
    EXPECT_EQ(low.column_marginal, 0.0);
    const RosenblattPoint high = transform({1.0, 1.0}, 1, 1);
    EXPECT_NEAR(high.marginal, 1.0, 1e-15);
    EXPECT_NEAR(high.conditional, 1.0, 1e-15);
    EXPECT_NEAR(high.column_marginal, 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace lightproof::reference
