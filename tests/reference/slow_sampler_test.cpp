#include "reference/slow_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "lightproof/core/error.h"
#include "maps.h"

namespace lightproof::reference {

void PrintTo(Texel texel, std::ostream* out) { *out << "(" << texel.x << ", " << texel.y << ")"; }

namespace {

constexpr double kBelowOne = 1.0 - 0x1p-53;

/// Black rows first and last, black texels at both ends of the lit rows.
EnvironmentMap framed_map() {
  return grey_map({4, 4}, {0, 0, 0, 0,  //
                           0, 1, 3, 0,  //
                           0, 0, 4, 0,  //
                           0, 0, 0, 0});
}

TEST(SlowSampler, TakesTheFirstLitTexelAtZero) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const SlowSampler sampler(framed_map(), {density_space});
    EXPECT_EQ(sampler.sample({0.0, 0.0}), (Texel{1, 1}));
  }
}

TEST(SlowSampler, TakesTheLastLitTexelJustBelowOne) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const SlowSampler sampler(framed_map(), {density_space});
    EXPECT_EQ(sampler.sample({kBelowOne, kBelowOne}), (Texel{2, 2}));
    EXPECT_EQ(sampler.sample({1.0, 1.0}), (Texel{2, 2})) << "even where it is not asked";
  }
}

TEST(SlowSampler, ChangesTexelWhereTheCumulativeMassIsPassed) {
  // Rows 1 and 2 are alike in mass under A and B; in row 1 the masses are 1/4 and 3/4.
  const SlowSampler sampler(framed_map(), {DensitySpace::texture});
  EXPECT_EQ(sampler.sample({0.0, 0.4999}), (Texel{1, 1}));
  EXPECT_EQ(sampler.sample({0.0, 0.5001}), (Texel{2, 2}));
  EXPECT_EQ(sampler.sample({0.2499, 0.1}), (Texel{1, 1}));
  EXPECT_EQ(sampler.sample({0.2501, 0.1}), (Texel{2, 1}));
}

TEST(SlowSampler, AnEntryBelongsToTheNextTexel) {
  // Powers of two are exact: the first cell whose cumulative mass lies *above* u.
  const SlowSampler sampler(grey_map({4, 1}, {1, 1, 1, 1}), {DensitySpace::texture});
  EXPECT_EQ(sampler.sample({0.25, 0.5}), (Texel{1, 0}));
  EXPECT_EQ(sampler.sample({std::nextafter(0.25, 0.0), 0.5}), (Texel{0, 0}));
}

TEST(SlowSampler, NeverTakesABlackTexel) {
  const EnvironmentMap map = framed_map();
  for (const DensitySpace density_space : kDensitySpaces) {
    const SlowSampler sampler(map, {density_space});
    for (int j = 0; j <= 512; ++j) {
      for (int i = 0; i <= 512; ++i) {
        const SquarePoint u = {std::min(i / 512.0, kBelowOne), std::min(j / 512.0, kBelowOne)};
        const Texel texel = sampler.sample(u);
        EXPECT_GT(map.radiance(texel.x, texel.y).r, 0.0F) << u.s << ", " << u.t;
      }
    }
  }
}

TEST(SlowSampler, DrawsEveryTexelInProportionToItsMass) {
  // On a lattice of 1000 x 1000 the count of a cell is off by one row and one column at most.
  const EnvironmentMap map = grey_map({3, 2}, {1, 2, 3, 0, 5, 1});
  const SlowSampler sampler(map, {DensitySpace::texture});
  Grid<int> counts({3, 2});
  for (int j = 0; j < 1000; ++j) {
    for (int i = 0; i < 1000; ++i) {
      const Texel texel = sampler.sample({(i + 0.5) / 1000.0, (j + 0.5) / 1000.0});
      ++counts(texel.x, texel.y);
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const double exact = 1e6 * static_cast<double>(map.radiance.values()[i].r) / 12.0;
    EXPECT_NEAR(counts.values()[i], exact, 2000.0);
  }
}

TEST(SlowSampler, RefusesABlackMap) {
  EXPECT_THROW(SlowSampler(grey_map({1, 1}, {0}), {DensitySpace::solid_angle}), InputError);
}

TEST(NearEntry, KnowsTheEntriesOfRowsAndColumns) {
  const SlowSampler sampler(framed_map(), {DensitySpace::texture});
  constexpr double kDistance = 1e-3;
  EXPECT_FALSE(sampler.near_entry({0.6, 0.3}, kDistance));
  for (const double off : {-0.9e-3, 0.9e-3}) {
    EXPECT_TRUE(sampler.near_entry({0.6, 0.5 + off}, kDistance)) << "row";
    EXPECT_TRUE(sampler.near_entry({0.25 + off, 0.3}, kDistance)) << "column of the first lit row";
  }
  for (const double off : {-1.1e-3, 1.1e-3}) {
    EXPECT_FALSE(sampler.near_entry({0.6, 0.5 + off}, kDistance));
    EXPECT_FALSE(sampler.near_entry({0.25 + off, 0.3}, kDistance));
  }
  EXPECT_FALSE(sampler.near_entry({0.25, 0.7}, kDistance)) << "no entry in the second lit row";
}

TEST(NearEntry, CountsBothEnds) {
  for (const EnvironmentMap& map : {framed_map(), grey_map({2, 2}, {1, 3, 2, 5})}) {
    const SlowSampler sampler(map, {DensitySpace::solid_angle});
    for (const double end : {0.0, 1e-7, 1.0 - 1e-7, kBelowOne}) {
      EXPECT_TRUE(sampler.near_entry({end, 0.3}, 1e-6)) << end;
      EXPECT_TRUE(sampler.near_entry({0.6, end}, 1e-6)) << end;
    }
  }
}

TEST(NearEntry, SaysWhereASlightErrorMayChangeTheTexel) {
  const SlowSampler sampler(framed_map(), {DensitySpace::solid_angle});
  constexpr double kShift = 1e-4;
  for (int j = 0; j < 211; ++j) {
    for (int i = 0; i < 211; ++i) {
      const SquarePoint u = {(i + 0.5) / 211.0, (j + 0.5) / 211.0};
      const bool stays = sampler.sample({u.s + kShift, u.t + kShift}) == sampler.sample(u) &&
                         sampler.sample({u.s - kShift, u.t - kShift}) == sampler.sample(u);
      EXPECT_TRUE(stays || sampler.near_entry(u, 1.01 * kShift)) << u.s << ", " << u.t;
    }
  }
}

}  // namespace
}  // namespace lightproof::reference
