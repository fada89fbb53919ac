#include "lightproof/image/look_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lightproof {
namespace {

Grid<double> grid_of(Extent extent, const std::vector<double>& values) {
  Grid<double> grid(extent);
  std::copy(values.begin(), values.end(), grid.values().begin());
  return grid;
}

// Places and values are multiples of powers of two, or rounded a few times: 1e-15.
constexpr double kRounding = 1e-15;

TEST(LookUp, NearestIsConstantInATexel) {
  const Grid<double> luminance = grid_of({2, 2}, {1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(look_up(luminance, Lookup::nearest, {0.0, 0.0}), 1.0);
  EXPECT_EQ(look_up(luminance, Lookup::nearest, {0.499, 0.499}), 1.0);
  EXPECT_EQ(look_up(luminance, Lookup::nearest, {0.5, 0.499}), 2.0);
  EXPECT_EQ(look_up(luminance, Lookup::nearest, {0.499, 0.5}), 3.0);
  EXPECT_EQ(look_up(luminance, Lookup::nearest, {1.0, 1.0}), 4.0);
}

TEST(LookUp, BilinearIsTheTexelsOwnInItsCentre) {
  const Grid<double> luminance = grid_of({3, 2}, {1.0, 2.0, 5.0, 3.0, 4.0, 8.0});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {(x + 0.5) / 3.0, (y + 0.5) / 2.0}),
                  luminance(x, y), 8.0 * kRounding);
    }
  }
}

TEST(LookUp, BilinearIsTheMeanOfFourAtACorner) {
  const Grid<double> luminance = grid_of({4, 2}, {1.0, 2.0, 5.0, 6.0, 3.0, 4.0, 8.0, 0.0});
  EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.5, 0.5}), (2.0 + 5.0 + 4.0 + 8.0) / 4.0,
              8.0 * kRounding);
  EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.4375, 0.375}),
              0.75 * (0.75 * 2.0 + 0.25 * 5.0) + 0.25 * (0.75 * 4.0 + 0.25 * 8.0), 8.0 * kRounding);
}

TEST(LookUp, BilinearWrapsAroundTheSeam) {
  const Grid<double> luminance = grid_of({4, 1}, {1.0, 2.0, 5.0, 3.0});
  for (const double s : {0.0, 1.0}) {
    EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {s, 0.5}), 2.0, 8.0 * kRounding);
  }
  EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.0625, 0.5}), 1.5, 8.0 * kRounding);
  EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.9375, 0.5}), 2.5, 8.0 * kRounding);
}

TEST(LookUp, BilinearIsClampedAtThePoles) {
  const Grid<double> luminance = grid_of({1, 2}, {1.0, 3.0});
  for (const double t : {0.0, 0.1, 0.25}) {
    EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.3, t}), 1.0, 8.0 * kRounding);
    EXPECT_NEAR(look_up(luminance, Lookup::bilinear, {0.3, 1.0 - t}), 3.0, 8.0 * kRounding);
  }
}

}  // namespace
}  // namespace lightproof
