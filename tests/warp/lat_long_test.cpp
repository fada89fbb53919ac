#include "lightproof/warp/lat_long.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace lightproof {
namespace {

TEST(LatLong, PolesAreExact) {
  EXPECT_EQ(direction_from_square({0.3, 0.0}), Direction(0.0, 0.0, -1.0));
  EXPECT_EQ(direction_from_square({0.3, 1.0}), Direction(0.0, 0.0, 1.0));
}

TEST(LatLong, MiddleOfTheMapLooksAlongX) {
  const Direction d = direction_from_square({0.5, 0.5});
  EXPECT_NEAR(d.x, 1.0, 1e-15);
  EXPECT_NEAR(d.y, 0.0, 1e-15);
  EXPECT_NEAR(d.z, 0.0, 1e-15);
}

TEST(LatLong, RoundTripKeepsThePoint) {
  for (int i = 0; i < 97; ++i) {
    for (int j = 0; j < 89; ++j) {
      const SquarePoint at = {(i + 0.5) / 97.0, (j + 0.5) / 89.0};
      const SquarePoint back = square_from_direction(direction_from_square(at));
      // A few roundings of numbers of order 1, and 1/sin(theta) <= 57 for the azimuth.
      EXPECT_NEAR(back.s, at.s, 1e-13);
      EXPECT_NEAR(back.t, at.t, 1e-15);
    }
  }
}

TEST(LatLong, ApproximationStaysInsideItsBound) {
  double worst = 0.0;
  for (int i = 0; i < 1999; ++i) {
    for (int j = 0; j < 997; ++j) {
      const SquarePoint at = {(i + 0.5) / 1999.0, (j + 0.5) / 997.0};
      const SquarePoint near = approximate_square_from_direction(direction_from_square(at));
      worst = std::max({worst, std::abs(near.s - at.s), std::abs(near.t - at.t)});
    }
  }
  EXPECT_LT(worst, 2e-8);
  EXPECT_GT(worst, 1e-12) << "as exact as the exact one: is it the approximation at all?";
}

TEST(LatLong, ApproximationKnowsTheAxes) {
  const Direction axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Direction axis : axes) {
    const SquarePoint exact = square_from_direction(axis);
    const SquarePoint near = approximate_square_from_direction(axis);
    EXPECT_NEAR(near.t, exact.t, 2e-8);
    if (axis.z == 0.0) {
      EXPECT_NEAR(near.s, exact.s, 2e-8);
    }
  }
}

TEST(LatLong, SolidAnglesOfTexelsSumToTheSphere) {
  for (const Extent extent : {Extent{1, 1}, Extent{2, 1}, Extent{7, 5}, Extent{1024, 512}}) {
    double sum = 0.0;
    for (int y = 0; y < extent.height; ++y) sum += extent.width * texel_solid_angle(extent, y);
    EXPECT_NEAR(sum / kSphere, 1.0, 1e-13) << extent.width << "x" << extent.height;
  }
}

TEST(LatLong, JacobianIntegratesToTheSphere) {
  // Midpoint rule on sin: error pi^2 / 24 n^2.
  constexpr int kRows = 10000;
  double sum = 0.0;
  for (int j = 0; j < kRows; ++j) sum += solid_angle_per_square((j + 0.5) / kRows) / kRows;
  EXPECT_NEAR(sum / kSphere, 1.0, 1e-8);
}

}  // namespace
}  // namespace lightproof
