#include "lightproof/core/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightproof {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(Extent, CountsCellsBeyondThirtyTwoBits) {
  EXPECT_EQ((Extent{7, 5}.count()), 35U);
  EXPECT_EQ((Extent{}.count()), 0U);
  EXPECT_EQ((Extent{65536, 65536}.count()), std::size_t{1} << 32U);
}

TEST(Grid, StoresRowByRow) {
  Grid<int> grid({3, 2});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) grid(x, y) = 10 * y + x;
  }
  EXPECT_THAT(grid.values(), ElementsAre(0, 1, 2, 10, 11, 12));
  EXPECT_THAT(grid.row(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(grid.row(1), ElementsAre(10, 11, 12));
  EXPECT_EQ(grid.extent(), (Extent{3, 2}));
}

TEST(Grid, RowsAreWindowsIntoTheGrid) {
  Grid<int> grid({3, 2});
  grid.row(1)[2] = 5;
  grid.values()[0] = 7;
  const Grid<int>& fixed = grid;
  EXPECT_EQ(fixed(2, 1), 5);
  EXPECT_EQ(fixed.row(1)[2], 5);
  EXPECT_EQ(fixed.values()[5], 5);
  EXPECT_EQ(fixed(0, 0), 7);
}

TEST(Grid, StartsWithItsValue) {
  EXPECT_THAT(Grid<double>({4, 3}).values(), Each(0.0));
  EXPECT_THAT(Grid<int>({4, 3}, 9).values(), Each(9));
  EXPECT_EQ(Grid<int>({4, 3}, 9).values().size(), 12U);
  EXPECT_TRUE(Grid<int>().values().empty());
}

TEST(Grid, CopiesAreIndependent) {
  Grid<int> first({2, 1}, 1);
  const Grid<int> second = first;
  first(0, 0) = 8;
  EXPECT_EQ(second(0, 0), 1);
}

}  // namespace
}  // namespace lightproof
