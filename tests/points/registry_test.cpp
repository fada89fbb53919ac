// What every row promises: points of [0,1)^2 for every index, the same whenever asked.
#include "lightproof/points/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "lightproof/core/error.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

const PointSeed kSeeds[] = {std::nullopt, 0U, 1U, 0xffffffffffffffffU};

bool is_in_square(SquarePoint point) {
  return point.s >= 0.0 && point.s < 1.0 && point.t >= 0.0 && point.t < 1.0;
}

/// 0, and every power of two with its neighbours, below the end.
std::vector<std::uint32_t> edge_indices(std::uint64_t end) {
  std::set<std::uint32_t> indices;
  const auto add = [&](std::uint64_t index) {
    if (index < end) indices.insert(static_cast<std::uint32_t>(index));
  };
  for (std::uint64_t power = 1; power <= kMostPoints; power *= 2) {
    for (const std::uint64_t index : {power - 1, power, power + 1}) add(index);
  }
  for (std::uint64_t before = 1; before <= std::min<std::uint64_t>(end, 200); ++before) {
    add(end - before);
  }
  return {indices.begin(), indices.end()};
}

TEST(PointSets, StayInTheSquareUpToTheLastIndex) {
  for (const PointSetInfo& info : point_sets()) {
    if (info.name == "hammersley float") continue;  // see HammersleyFloat
    for (const PointSeed seed : kSeeds) {
      for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{1000},
                                        kMostPoints - 1, kMostPoints}) {
        const AnyPointSet set = info.prepare(count, seed);
        for (const std::uint32_t index : edge_indices(info.is_finite ? count : kMostPoints)) {
          const SquarePoint point = point_of(set, index);
          EXPECT_TRUE(is_in_square(point)) << info.name << ", " << count << " points, index "
                                           << index << ": " << point.s << ", " << point.t;
        }
      }
    }
  }
}

TEST(PointSets, GiveTheSamePointsOneByOneOrManyAtOnce) {
  for (const PointSetInfo& info : point_sets()) {
    const AnyPointSet set = info.prepare(kMostPoints, 7U);
    for (const std::uint64_t first : {std::uint64_t{0}, kMostPoints - 100}) {
      const std::vector<SquarePoint> many = window_of(info.name, kMostPoints, first, 100, 7U);
      for (std::size_t i = 0; i < many.size(); ++i) {
        EXPECT_EQ(many[i], point_of(set, static_cast<std::uint32_t>(first + i))) << info.name;
      }
    }
  }
}

TEST(PointSets, DifferBetweenSeeds) {
  for (const PointSetInfo& info : point_sets()) {
    const auto once = all_of(info.name, 256, 1U);
    EXPECT_NE(once, all_of(info.name, 256, 2U)) << info.name;
    EXPECT_NE(once, all_of(info.name, 256, 1U + (std::uint64_t{1} << 32U))) << info.name;
  }
}

TEST(PointSets, DependOnTheirCountIfTheyAreFinite) {
  for (const PointSetInfo& info : point_sets()) {
    EXPECT_EQ(window_of(info.name, 64, 0, 64) != window_of(info.name, 4096, 0, 64), info.is_finite)
        << info.name;
  }
}

// Unseeded: lattices and nets are as their sources have them.
TEST(PointSets, AreNotRandomWithoutASeedIfTheyAreLatticesOrNets) {
  for (const PointSetInfo& info : point_sets()) {
    if (info.kind != PointKind::lattice && info.kind != PointKind::net) continue;
    const SquarePoint first = all_of(info.name, 64).front();
    const SquarePoint corner = {0.0, 0.0};
    const SquarePoint middle = {0.5, 0.5};
    const SquarePoint of_one = {1.0 / 64.0, 0.5};
    EXPECT_TRUE(first == corner || first == middle || first == of_one) << info.name;
  }
}

TEST(PointSets, RefuseCountsThatIndicesCannotHave) {
  for (const PointSetInfo& info : point_sets()) {
    EXPECT_THROW(info.prepare(0), InputError) << info.name;
    EXPECT_THROW(info.prepare(kMostPoints + 1), InputError) << info.name;
  }
  try {
    point_set_by_name("R2").prepare(0);
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "the point set \"R2\" cannot have 0 points: 1 to 4294967296 are allowed");
  }
}

TEST(PointSets, HaveNamesThatAreFoundAndDiffer) {
  std::set<std::string_view> names;
  for (const PointSetInfo& info : point_sets()) {
    names.insert(info.name);
    EXPECT_EQ(&point_set_by_name(info.name), &info);
    EXPECT_FALSE(info.description.empty());
    EXPECT_FALSE(info.source.empty());
    EXPECT_FALSE(to_string(info.kind).empty());
  }
  EXPECT_EQ(names.size(), point_sets().size());
  EXPECT_THROW(point_set_by_name("halton"), InputError);
}

// Every form that is computed in float has its defect named.
TEST(PointSets, NameTheDefectsOfFloats) {
  for (const PointSetInfo& info : point_sets()) {
    if (info.is_float) {
      EXPECT_FALSE(info.defect.empty()) << info.name;
    }
  }
}

/// How many different values there are.
std::size_t distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

// Lattices and nets in fixed point: wherever 2^16 neighbours are taken, both coordinates differ
// among all of them.
TEST(LatticesAndNets, AreDistinctWhereverTheyAreTaken) {
  constexpr std::uint64_t kWindow = 65536;
  for (const PointSetInfo& info : point_sets()) {
    if (info.is_float) continue;
    if (info.kind != PointKind::lattice && info.kind != PointKind::net) continue;
    for (const PointSeed seed : kSeeds) {
      for (const std::uint64_t first :
           {std::uint64_t{0}, std::uint64_t{1} << 24U, std::uint64_t{1} << 31U,
            (std::uint64_t{1} << 31U) - kWindow / 2, kMostPoints - kWindow}) {
        std::vector<double> s;
        std::vector<double> t;
        for (const SquarePoint p : window_of(info.name, kMostPoints, first, kWindow, seed)) {
          s.push_back(p.s);
          t.push_back(p.t);
        }
        EXPECT_EQ(distinct(s), kWindow) << info.name << " from " << first;
        EXPECT_EQ(distinct(t), kWindow) << info.name << " from " << first;
      }
    }
  }
}

}  // namespace
}  // namespace lightproof::test
