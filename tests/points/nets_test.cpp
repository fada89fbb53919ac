// Hammersley's points, Sobol's and stratified ones: known values, and one point in each elementary
// interval.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "lightproof/points/hammersley.h"
#include "lightproof/points/radical_inverse.h"
#include "lightproof/points/sobol.h"
#include "lightproof/points/stratified.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

TEST(RadicalInverse, MirrorsDigits) {
  const double known[] = {0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875, 0.0625};
  for (std::uint64_t n = 0; n < std::size(known); ++n) EXPECT_EQ(radical_inverse(n), known[n]);
  EXPECT_EQ(radical_inverse(0xffffffffU), 1.0 - 0x1p-32);
  EXPECT_EQ(radical_inverse(kMostPoints), 0x1p-33);
  EXPECT_EQ(radical_inverse((std::uint64_t{1} << 53U) - 1), 1.0 - 0x1p-53);
  // Digit by digit.
  for (std::uint64_t n = 1; n < 1000000000; n = 3 * n + 1) {
    double value = 0.0;
    double digit = 0.5;
    for (std::uint64_t rest = n; rest > 0; rest /= 2, digit *= 0.5) {
      value += digit * static_cast<double>(rest % 2);
    }
    EXPECT_EQ(radical_inverse(n), value) << n;
  }
}

TEST(Hammersley, IsRankAndRadicalInverseFromZeroOrOne) {
  const auto from_zero = all_of("hammersley", 5);
  const auto from_one = all_of("hammersley from 1", 5);
  const std::vector<SquarePoint> expected = {
      {0.0, 0.0}, {1.0 / 5, 0.5}, {2.0 / 5, 0.25}, {3.0 / 5, 0.75}, {4.0 / 5, 0.125}};
  EXPECT_EQ(from_zero, expected);
  const std::vector<SquarePoint> later = {
      {1.0 / 5, 0.5}, {2.0 / 5, 0.25}, {3.0 / 5, 0.75}, {4.0 / 5, 0.125}, {0.0, 0.625}};
  EXPECT_EQ(from_one, later);
}

// The last of 2^32 points counted from 1 has a number of 33 bits.
TEST(Hammersley, CountsToTheEnd) {
  const AnyPointSet from_one = point_set_by_name("hammersley from 1").prepare(kMostPoints);
  EXPECT_EQ(point_of(from_one, 0xffffffffU), (SquarePoint{0.0, 0x1p-33}));
  const AnyPointSet from_zero = point_set_by_name("hammersley").prepare(kMostPoints);
  EXPECT_EQ(point_of(from_zero, 0xffffffffU), (SquarePoint{1.0 - 0x1p-32, 1.0 - 0x1p-32}));
}

// Indices of n = 2^25 - 1 and of N: the first of each.
TEST(HammersleyFloat, ReachesOne) {
  const HammersleyFloat set(kMostPoints, {});
  constexpr std::uint32_t kFirst = (1U << 25U) - 2U;
  for (std::uint32_t index = 0; index < kFirst; ++index) {
    if (set.point(index).t >= 1.0) FAIL() << "at " << index;
  }
  EXPECT_EQ(set.point(kFirst).t, 1.0);
  EXPECT_EQ(HammersleyFloat(1000, {}).point(999).s, 1.0);
  EXPECT_LT(HammersleyFloat(1000, {}).point(998).s, 1.0);
  // Rounded up: n/N is below 1 still.
  EXPECT_EQ(set.point(0xfffffffeU).s, 1.0);
}

TEST(HammersleyFloat, IsHammersleyRounded) {
  const auto exact = all_of("hammersley from 1", 1000);
  const auto rounded = all_of("hammersley float", 1000);
  for (std::size_t i = 0; i + 1 < exact.size(); ++i) {
    EXPECT_NEAR(rounded[i].s, exact[i].s, 0x1p-25);
    EXPECT_EQ(rounded[i].t, exact[i].t);
  }
}

/// Whether each elementary interval [i 2^-a, (i+1) 2^-a) x [j 2^-b, (j+1) 2^-b) with a + b = m
/// holds exactly one of the 2^m points.
bool is_net(const std::vector<SquarePoint>& points) {
  const auto m = static_cast<unsigned>(std::countr_zero(points.size()));
  for (unsigned a = 0; a <= m; ++a) {
    const unsigned b = m - a;
    std::vector<bool> taken(points.size());
    for (const SquarePoint p : points) {
      const auto i = static_cast<std::size_t>(std::ldexp(p.s, static_cast<int>(a)));
      const auto j = static_cast<std::size_t>(std::ldexp(p.t, static_cast<int>(b)));
      const std::size_t cell = (i << b) + j;
      if (taken[cell]) return false;
      taken[cell] = true;
    }
  }
  return true;
}

TEST(Nets, HaveOnePointInEachElementaryInterval) {
  for (unsigned m = 0; m <= 12; ++m) {
    const std::uint64_t count = std::uint64_t{1} << m;
    EXPECT_TRUE(is_net(all_of("hammersley", count))) << m;
    EXPECT_TRUE(is_net(all_of("hammersley from 1", count))) << m;
    EXPECT_TRUE(is_net(all_of("sobol", count))) << m;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      EXPECT_TRUE(is_net(all_of("sobol", count, seed))) << m << ", seed " << seed;
    }
  }
  EXPECT_FALSE(is_net(all_of("philox", 64)));
  EXPECT_FALSE(is_net(all_of("R2", 64)));
}

// A (0,2)-sequence: so does every aligned block, wherever it stands.
TEST(Sobol, HasOnePointInEachElementaryIntervalOfEveryBlock) {
  for (const PointSeed seed : {PointSeed(), PointSeed(3)}) {
    for (const std::uint64_t block :
         {std::uint64_t{1}, std::uint64_t{5}, std::uint64_t{16384}, (kMostPoints >> 10U) - 1}) {
      EXPECT_TRUE(is_net(window_of("sobol", kMostPoints, block << 10U, 1024, seed))) << block;
    }
  }
}

/// Joe and Kuo's row d = 2: degree s = 1, coefficients a = 0, m_1 = 1. Their recurrence for v_k =
/// m_k / 2^k, which for s = 1 is m_k = 2 m_(k-1) xor m_(k-1).
double sobol_by_direction_numbers(std::uint32_t index) {
  std::uint64_t m = 1;
  std::uint64_t sum = 0;  // in units of 2^-32
  for (unsigned k = 1; index != 0; ++k, index /= 2) {
    if (index % 2 == 1) sum ^= m << (32U - k);
    m = (2 * m) ^ m;
  }
  return std::ldexp(static_cast<double>(sum), -32);
}

TEST(Sobol, HasTheDirectionNumbersOfJoeAndKuo) {
  const AnyPointSet set = point_set_by_name("sobol").prepare(1);
  const std::vector<SquarePoint> known = {{0.0, 0.0},     {0.5, 0.5},     {0.25, 0.75},
                                          {0.75, 0.25},   {0.125, 0.625}, {0.625, 0.125},
                                          {0.375, 0.375}, {0.875, 0.875}};
  EXPECT_EQ(all_of("sobol", 8), known);
  for (std::uint32_t index = 1; index < 0xf0000000U; index += 1 + index / 3) {
    EXPECT_EQ(point_of(set, index).s, radical_inverse(index));
    EXPECT_EQ(point_of(set, index).t, sobol_by_direction_numbers(index)) << index;
  }
}

// A bit is turned over or not by the bits before it and the seed alone: words that agree in the
// first k bits agree in the first k bits when scrambled, and differ in the next if they do.
TEST(OwenScrambling, KeepsWhatElementaryIntervalsSee) {
  const auto scrambled = [](std::uint32_t word, std::uint32_t seed) {
    return reversed_bits(owen_scrambled_reversed(reversed_bits(word), seed));
  };
  for (std::uint32_t seed = 1; seed != 0 && seed < 0x80000000U; seed = seed * 3U + 1U) {
    for (unsigned k = 0; k < 32; ++k) {
      const std::uint32_t word = seed * 0x9e3779b9U;
      const std::uint32_t other = word ^ (0x80000000U >> k) ^ ((seed >> 1U) & (0x7fffffffU >> k));
      EXPECT_EQ(std::countl_zero(scrambled(word, seed) ^ scrambled(other, seed)),
                static_cast<int>(k));
    }
  }
}

TEST(Stratified, HasOnePointInEachCell) {
  for (const std::uint64_t count : {1U, 2U, 12U, 64U, 97U, 1000U, 4096U}) {
    const StratifiedPoints set(count, 1U);
    ASSERT_EQ(set.columns() * set.rows(), count);
    std::set<std::pair<std::uint64_t, std::uint64_t>> cells;
    for (std::uint32_t i = 0; i < count; ++i) {
      const SquarePoint p = set.point(i);
      cells.emplace(static_cast<std::uint64_t>(p.s * static_cast<double>(set.columns())),
                    static_cast<std::uint64_t>(p.t * static_cast<double>(set.rows())));
    }
    EXPECT_EQ(cells.size(), count);
  }
}

TEST(Stratified, HasCellsAsSquareAsTheCountAllows) {
  const auto shape = [](std::uint64_t count) {
    const StratifiedPoints set(count, {});
    return std::pair(set.columns(), set.rows());
  };
  EXPECT_EQ(shape(1), std::pair(std::uint64_t{1}, std::uint64_t{1}));
  EXPECT_EQ(shape(12), std::pair(std::uint64_t{4}, std::uint64_t{3}));
  EXPECT_EQ(shape(4096), std::pair(std::uint64_t{64}, std::uint64_t{64}));
  EXPECT_EQ(shape(97), std::pair(std::uint64_t{97}, std::uint64_t{1}));
  EXPECT_EQ(shape(kMostPoints), std::pair(std::uint64_t{65536}, std::uint64_t{65536}));
}

}  // namespace
}  // namespace lightproof::test
