// Coordinates outside of the map, and maps larger than a table has numbers for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/samplers/guide_table.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CellOf, IsTheCellThatACoordinateLiesIn) {
  for (const int count : {1, 2, 7, 8192}) {
    for (int cell = 0; cell < count; ++cell) {
      EXPECT_EQ(cell_of((cell + 0.5) / count, count), cell);
    }
    EXPECT_EQ(cell_of(0.0, count), 0);
    EXPECT_EQ(cell_of(1.0, count), count - 1);
  }
}

TEST(CellOf, IsTheNearerEndOutsideOfTheMap) {
  for (const double beyond : {1.5, 1e10, 1e300, kInfinity}) {
    EXPECT_EQ(cell_of(beyond, 8), 7) << beyond;
    EXPECT_EQ(cell_of(-beyond, 8), 0) << -beyond;
  }
}

TEST(CellOf, IsTheFirstOfWhatIsNotANumber) {
  EXPECT_EQ(cell_of(std::numeric_limits<double>::quiet_NaN(), 8), 0);
  EXPECT_EQ(cell_of(-std::numeric_limits<double>::quiet_NaN(), 8), 0);
}

/// As wide as this, of one row with different greys.
EnvironmentMap strip(int width) {
  EnvironmentMap map;
  map.name = "strip";
  map.radiance = Grid<Rgb>({width, 1});
  for (int x = 0; x < width; ++x) map.radiance(x, 0) = Rgb(static_cast<float>(1 + x % 7));
  return map;
}

TEST(GuideTable, DrawsEveryColumnThatItHasNumbersFor) {
  constexpr int kMost = 65536;
  const EnvironmentMap map = strip(kMost);
  const TargetDensity target = {DensitySpace::texture, kRec709};
  const GuideTable guided(map, target);
  const BinarySearch searched(map, target);
  const RandomStream stream("tests/limits", 1);
  for (std::uint64_t i = 0; i < 4096; ++i) {
    EXPECT_EQ(guided.sample(stream.point(i)).x, searched.sample(stream.point(i)).x);
  }
  EXPECT_EQ(guided.sample({1.0 - 0x1p-53, 0.5}).x, kMost - 1);
}

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GuideTable, RefusesMoreColumnsThanItHasNumbersFor) {
  const EnvironmentMap map = strip(65537);
  EXPECT_THAT(refusal_of([&] {
                GuideTable(map, {DensitySpace::texture, kRec709});
              }),
              AllOf(HasSubstr("65537"), HasSubstr("65536"), HasSubstr("scale the map down")));
}

TEST(AliasTable, RefusesMoreCellsThanItHasNumbersFor) {
  const double weight = 1.0;
  // Nothing is read of so many.
  const CellWeights weights(std::span(&weight, (std::size_t{1} << 32U) + 1));
  EXPECT_THAT(refusal_of([&] { const AliasTable table(weights); }), HasSubstr("4294967297"));
}

}  // namespace
}  // namespace lightproof
