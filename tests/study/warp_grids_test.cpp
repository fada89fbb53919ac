#include "lightproof/study/warp_grids.h"

#include <gtest/gtest.h>

#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

TEST(WarpGrids, StayTogetherThroughAMonotoneTableAloneOfTheTwo) {
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("sun-sky", {64, 32})};
  const std::vector<WarpGrid> grids = study_warp_grids(maps);
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_TRUE(grids[0].is_monotone);
  EXPECT_FALSE(grids[1].is_monotone);
  for (const WarpGrid& grid : grids) EXPECT_EQ(grid.points.size(), 31U * 31U);
  EXPECT_GT(grids[1].neighbour_degrees, grids[0].neighbour_degrees);
  // Along a row of the grid a monotone table goes one way.
  for (std::size_t i = 1; i < grids[0].points.size(); ++i) {
    if (i % 31 == 0) continue;
    EXPECT_GE(grids[0].points[i].s, grids[0].points[i - 1].s) << i;
  }
}

}  // namespace
}  // namespace lightproof
