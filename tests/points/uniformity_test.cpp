// Points that claim to be independent and uniform: goodness of fit of single coordinates, of
// points, and of successive ones, wherever in the sequence they are taken.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/stats/goodness_of_fit.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

constexpr std::uint64_t kPoints = std::uint64_t{1} << 18U;
constexpr int kSide = 64;  ///< cells of a side of the square, and the root of those of a line

std::size_t cell_in(double x, int cells) { return static_cast<std::size_t>(x * cells); }

/// log10 of the p-value of counts over cells of equal probability.
double log10_p_of(const std::vector<std::uint64_t>& counts, std::uint64_t samples) {
  const std::vector<double> probability(counts.size(), 1.0 / static_cast<double>(counts.size()));
  return cressie_read(counts, probability, samples).log10_p;
}

/// Pairs of numbers over a grid of kSide x kSide cells; a 1 that a float was rounded to counts as
/// 0.
template <class First, class Second>
double pair_fit(std::size_t pairs, First first, Second second) {
  std::vector<std::uint64_t> counts(kSide * kSide);
  for (std::size_t i = 0; i < pairs; ++i) {
    ++counts[cell_in(first(i), kSide) * kSide + cell_in(second(i), kSide)];
  }
  return log10_p_of(counts, pairs);
}

/// The least of the p-values of: s and t over 4096 cells each, points, and pairs of neighbours that
/// do not overlap, in s and in t.
double least_log10_p(const std::vector<SquarePoint>& points) {
  std::vector<std::uint64_t> along_s(kSide * kSide);
  std::vector<std::uint64_t> along_t(kSide * kSide);
  for (const SquarePoint p : points) {
    ++along_s[cell_in(p.s, kSide * kSide)];
    ++along_t[cell_in(p.t, kSide * kSide)];
  }
  const auto s = [&](std::size_t i) { return points[i].s; };
  const auto t = [&](std::size_t i) { return points[i].t; };
  const auto even = [](auto of) { return [of](std::size_t i) { return of(2 * i); }; };
  const auto odd = [](auto of) { return [of](std::size_t i) { return of(2 * i + 1); }; };
  const std::size_t half = points.size() / 2;
  return std::min({log10_p_of(along_s, points.size()), log10_p_of(along_t, points.size()),
                   pair_fit(points.size(), s, t), pair_fit(half, even(s), odd(s)),
                   pair_fit(half, even(t), odd(t))});
}

/// From the beginning, across the indices at which floats and signed numbers of 32 bits end, and at
/// the end.
constexpr std::uint64_t kFirsts[] = {0, (std::uint64_t{1} << 24U) - kPoints / 2,
                                     (std::uint64_t{1} << 31U) - kPoints / 2,
                                     kMostPoints - kPoints};
constexpr std::uint64_t kSeeds = 3;

// 2 sets, 4 windows, 3 seeds, 5 tests: together they reject right points with probability 1e-6.
TEST(RandomPointsAndHashes, AreUniformAndIndependentWhereverTheyAreTaken) {
  const double log10_level = std::log10(1e-6 / (2.0 * 4.0 * 3.0 * 5.0));
  for (const PointSetInfo& info : point_sets()) {
    if (info.kind != PointKind::random && info.kind != PointKind::hash) continue;
    if (!info.defect.empty()) continue;
    for (const std::uint64_t first : kFirsts) {
      for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        EXPECT_GT(least_log10_p(window_of(info.name, kMostPoints, first, kPoints, seed)),
                  log10_level)
            << info.name << " from " << first << ", seed " << seed;
      }
    }
  }
}

// The tests see what is wrong with each of the hashes that have a defect, and with points that are
// too even.
TEST(RandomPointsAndHashes, AreRejectedIfTheyHaveADefect) {
  const auto from = [](std::string_view set, std::uint64_t first) {
    return least_log10_p(window_of(set, kMostPoints, first, kPoints, 1U));
  };
  constexpr std::uint64_t kFloatsEnd = std::uint64_t{1} << 24U;
  EXPECT_GT(from("pcg3d converted", 0), -8.0);
  EXPECT_LT(from("pcg3d converted", kFloatsEnd), -100.0);
  EXPECT_GT(from("pcg3d counted", 0), -8.0);
  EXPECT_LT(from("pcg3d counted", kFloatsEnd), -100.0);
  EXPECT_LT(from("sine hash", 0), -100.0);
  EXPECT_LT(from("R2", 0), -100.0);
  EXPECT_LT(from("R2 float", 0), -100.0);
  EXPECT_LT(least_log10_p(all_of("stratified", kPoints, 1U)), -100.0);
}

}  // namespace
}  // namespace lightproof::test
