// What is left of the points that floats give, window by window.
#include "lightproof/points/float_decay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

constexpr std::uint64_t kWindow = 65536;
constexpr std::uint64_t kFloatsEnd = std::uint64_t{1} << 24U;

FloatDecay decay_of(std::string_view set, std::uint64_t first) {
  return float_decay_at(point_set_by_name(set), first, kWindow);
}

// The first index, and powers of two, as many as leave room for a window; the last window ends at
// 2^32.
TEST(FloatDecay, GoesThroughThePowersOfTwo) {
  const auto rows = float_decay(point_set_by_name("R2 float"), kWindow);
  ASSERT_EQ(rows.size(), 1U + 32U + 1U);
  EXPECT_EQ(rows[0].first, 0U);
  for (std::size_t k = 0; k < 32; ++k) EXPECT_EQ(rows[k + 1].first, std::uint64_t{1} << k);
  EXPECT_EQ(rows.back().first, kMostPoints - kWindow);
  EXPECT_EQ(rows.back().set, "R2 float");
  EXPECT_EQ(rows.back().window, kWindow);
}

TEST(FloatDecay, FindsNoneInFixedPoint) {
  for (const PointSetInfo& info : point_sets()) {
    if (info.is_float) continue;
    for (const std::uint64_t first : {std::uint64_t{0}, kFloatsEnd, kMostPoints - kWindow}) {
      const FloatDecay decay = float_decay_at(info, first, kWindow);
      // Of 2^16 random pairs of words of 24 bits or more some two in 2^17 coincide.
      EXPECT_GE(decay.distinct, kWindow - 2) << info.name;
      EXPECT_EQ(decay.error_s, 0.0) << info.name;
      EXPECT_EQ(decay.error_t, 0.0) << info.name;
    }
  }
}

template <class Set>
void expect_near_exact(const Set& set) {
  if constexpr (requires { set.exact_point(0U); }) {
    for (std::uint32_t index = 0; index < 63; ++index) {
      const SquarePoint point = set.point(index);
      const SquarePoint exact = set.exact_point(index);
      const SquarePoint apart = {std::abs(point.s - exact.s), std::abs(point.t - exact.t)};
      // Three roundings of numbers below 64, and a shift of 24 bits; on the circle.
      const double bound = 4.0 * 64.0 * 0x1p-24;
      EXPECT_LT(std::min(apart.s, 1.0 - apart.s), bound) << index;
      EXPECT_LT(std::min(apart.t, 1.0 - apart.t), bound) << index;
    }
  }
}

// At the beginning nothing has decayed, shifted or not: the forms in float are what they stand for.
// The sine hash is not: its factor makes 4e-3 of a float's rounding.
TEST(FloatDecay, BeginsWithNone) {
  for (const PointSetInfo& info : point_sets()) {
    if (!info.is_float || info.name == "sine hash") continue;
    SCOPED_TRACE(info.name);
    for (const PointSeed seed : {PointSeed(), PointSeed(1), PointSeed(2)}) {
      std::visit([](const auto& set) { expect_near_exact(set); }, info.prepare(64, seed));
    }
  }
  // And those are the ones in fixed point.
  const AnyPointSet fixed = point_set_by_name("R2").prepare(64);
  for (std::uint32_t n = 0; n < 64; ++n) {
    const SquarePoint exact = R2Float({}).exact_point(n);
    EXPECT_NEAR(point_of(fixed, n).s, exact.s, n * 0x1p-33);
    EXPECT_NEAR(point_of(fixed, n).t, exact.t, n * 0x1p-33);
  }
}

// As the floats of alpha n have 2^(23-e) steps behind the point where alpha n is in [2^e, 2^(e+1)):
// where a window has more points than that, it has all of them, and no other.
TEST(FloatDecay, LeavesAsManyValuesAsThereAreBitsBehindThePoint) {
  const double alpha = 1.0 / 1.32471795724474602596;
  for (int k = 14; k < 32; ++k) {
    const std::uint64_t first = std::uint64_t{1} << k;
    // The coarsest and the finest steps that are met in the window.
    const int from = std::ilogb(alpha * static_cast<double>(first));
    const int to = std::ilogb(alpha * static_cast<double>(first + kWindow));
    const auto values = [](int exponent) {
      return static_cast<std::uint64_t>(exponent >= 23 ? 1 : 1 << (23 - exponent));
    };
    const FloatDecay decay = decay_of("R2 float", first);
    EXPECT_LE(decay.distinct_s, values(from)) << k;
    EXPECT_GE(decay.distinct_s, values(to)) << k;
  }
}

// Measured with another program as well.
TEST(FloatDecay, LeavesFewPointsOfR2) {
  EXPECT_EQ(decay_of("R2 float", 0).distinct, 64824U);
  EXPECT_EQ(decay_of("R2 float", 100000).distinct, 23644U);
  EXPECT_EQ(decay_of("R2 float", 1000000).distinct, 256U);
  EXPECT_EQ(decay_of("R2 float", 10000000).distinct, 4U);
  EXPECT_EQ(decay_of("R2 float", kFloatsEnd).distinct, 1U);
  EXPECT_EQ(decay_of("R2", kFloatsEnd).distinct, kWindow);
}

// The factor's rounding grows with n; n, the product and the sum are rounded by half a unit of
// their last places each.
TEST(FloatDecay, HasTheErrorOfItsRoundings) {
  struct Row {
    std::string_view set;
    double alpha;
  };
  const Row rows[] = {{"golden float", (std::sqrt(5.0) - 1.0) / 2.0},
                      {"silver float", std::sqrt(2.0) - 1.0},
                      {"bronze float", (std::sqrt(13.0) - 3.0) / 2.0}};
  for (const Row& row : rows) {
    const double of_factor =
        std::abs(static_cast<double>(static_cast<float>(row.alpha)) - row.alpha);
    for (const FloatDecay& decay : float_decay(point_set_by_name(row.set), kWindow)) {
      const double n = static_cast<double>(decay.first + kWindow);
      const double roundings = 3.0 * row.alpha * n * 0x1p-24;
      EXPECT_LE(decay.error_t, std::min(0.5, of_factor * n + roundings)) << decay.first;
      if (of_factor * n + roundings < 0.5) {
        EXPECT_GE(decay.error_t, of_factor * n - roundings) << decay.first;
      }
      EXPECT_EQ(decay.error_s, 0.0);
    }
    EXPECT_GT(decay_of(row.set, 4 * kFloatsEnd).error_t, 0.49);
    EXPECT_EQ(decay_of(row.set, 4 * kFloatsEnd).distinct_t, 1U);
  }
}

// From 2^24 on a float holds every second whole number, from 2^25 on every fourth. The last of a
// window may round up to one more.
TEST(FloatDecay, LeavesEverySecondFrameOfAConvertedIndex) {
  EXPECT_EQ(decay_of("pcg3d converted", kFloatsEnd - kWindow).error_s, 0.0);
  for (unsigned k = 0; k < 8; ++k) {
    const FloatDecay decay = decay_of("pcg3d converted", kFloatsEnd << k);
    EXPECT_EQ(decay.distinct, (kWindow >> (k + 1U)) + 1U);
    EXPECT_GT(decay.error_s, 0.49);
  }
}

TEST(FloatDecay, LeavesOneFrameOfAFloatCounter) {
  EXPECT_EQ(decay_of("pcg3d counted", kFloatsEnd - kWindow).distinct,
            decay_of("pcg3d", kFloatsEnd - kWindow).distinct);
  EXPECT_EQ(decay_of("pcg3d counted", kFloatsEnd - kWindow / 2).distinct,
            decay_of("pcg3d", kFloatsEnd - kWindow / 2).distinct - kWindow / 2 + 1);
  EXPECT_EQ(decay_of("pcg3d counted", kFloatsEnd).distinct, 1U);
  EXPECT_EQ(decay_of("pcg3d counted", kMostPoints - kWindow).distinct, 1U);
}

TEST(FloatDecay, CountsFewValuesOfTheSineHash) {
  // Its values are multiples of 2^-8 for 46 % of the places, of 2^-9 for 27 %, …
  EXPECT_LT(decay_of("sine hash", 0).distinct_s, kWindow / 8);
  EXPECT_GT(decay_of("sine hash", 0).distinct_s, 256U);
}

TEST(FloatDecay, DoesNotDependOnThreads) {
  const PointSetInfo& set = point_set_by_name("sine hash");
  const auto many = float_decay(set, 256);
  const ThreadLimit one(1);
  const auto few = float_decay(set, 256);
  ASSERT_EQ(many.size(), few.size());
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_EQ(many[i].error_s, few[i].error_s);
    EXPECT_EQ(many[i].distinct, few[i].distinct);
  }
}

}  // namespace
}  // namespace lightproof::test
