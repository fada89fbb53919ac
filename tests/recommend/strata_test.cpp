// The variance inside strata, against closed forms.
#include "lightproof/recommend/strata.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

// s + 2t varies by 1/12 + 4/12 over the square, and by a 4^j-th of that inside of 4^j squares. That
// of points that are themselves in strata is 1/15 more of 16 of them; of 64 rows with one t each
// the variance of t is known to sqrt(2/64), 18 %, at the worst.
TEST(Strata, OfALinearFunctionHaveAShareOfItsVariance) {
  std::vector<double> values;
  for (const SquarePoint at : strata_points()) values.push_back(at.s + 2.0 * at.t);
  const StrataVariances inside = variances_inside(values);
  for (std::size_t grid = 0; grid < kStrataGrids; ++grid) {
    const double expected = 5.0 / 12.0 / std::pow(4.0, static_cast<double>(grid));
    EXPECT_NEAR(inside[grid] / expected, 1.0, 0.25) << grid;
  }
}

TEST(Strata, OfAConstantHaveNoVariance) {
  const std::vector<double> values(kStrataPoints, 3.0);
  for (const double variance : variances_inside(values)) EXPECT_NEAR(variance, 0.0, 1e-24);
}

TEST(Strata, AreThoseThatSoManySamplesFill) {
  EXPECT_EQ(strata_grid_of(1), 0U);
  EXPECT_EQ(strata_grid_of(3), 0U);
  EXPECT_EQ(strata_grid_of(4), 1U);
  EXPECT_EQ(strata_grid_of(16), 2U);
  EXPECT_EQ(strata_grid_of(255), 3U);
  EXPECT_EQ(strata_grid_of(256), 4U);
  EXPECT_EQ(strata_grid_of(65536), 4U);
}

}  // namespace
}  // namespace lightproof
