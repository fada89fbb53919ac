#include "lightproof/stats/change_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "lightproof/core/random.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// A log-normal level of 100 with a spread of 2 %.
std::vector<double> level(std::uint64_t substream, std::size_t count, double factor = 1.0) {
  const RandomStream stream("stats/change-points", 1, substream);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double z = normal_quantile(stream.point(i).s + 0x1p-54);
    values.push_back(100.0 * factor * std::exp(0.02 * z));
  }
  return values;
}

std::vector<double> joined(std::vector<double> values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

TEST(ChangePoints, StandWhereTheLevelChanges) {
  const auto series = joined(joined(level(1, 15), level(2, 12, 1.3)), level(3, 15, 1.1));
  const auto changes = change_points(series, {});
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].first, 15U);
  EXPECT_EQ(changes[1].first, 27U);
  // Medians of a dozen values with a spread of 2 % are within 5 %.
  EXPECT_NEAR(changes[0].ratio, 1.3, 0.05);
  EXPECT_NEAR(changes[1].ratio, 1.1 / 1.3, 0.05);
  EXPECT_LT(changes[0].log10_p, -2.0);
}

TEST(ChangePoints, BelowTheLeastRatioAreNone) {
  // Medians of 40 have standard errors of 0.4 %: 1.02 is five of their differences from 1.05, and
  // three from 1.
  const auto series = joined(level(4, 40), level(5, 40, 1.02));
  EXPECT_TRUE(change_points(series, {}).empty());
  EXPECT_EQ(change_points(series, {0.01, 1.0}).size(), 1U);
}

TEST(ChangePoints, NeedEnoughValues) {
  EXPECT_TRUE(change_points({}, {}).empty());
  EXPECT_TRUE(change_points(std::vector<double>{1.0}, {}).empty());
  // Twice 4 values: p is 2 / C(8, 4) at least.
  EXPECT_TRUE(change_points(joined(level(6, 4), level(7, 4, 2.0)), {}).empty());
}

TEST(ChangePoints, AreMarkedByChanceNoMoreOftenThanAlphaSays) {
  constexpr int kSeries = 2000;
  constexpr double kAlpha = 0.05;
  int marked = 0;
  for (int i = 0; i < kSeries; ++i) {
    const auto series = level(1000 + static_cast<std::uint64_t>(i), 20);
    marked += change_points(series, {kAlpha, 1.0}).empty() ? 0 : 1;
  }
  // Below alpha but for five standard deviations; and not so far below that nothing was looked for.
  const double deviation = std::sqrt(kSeries * kAlpha * (1.0 - kAlpha));
  EXPECT_LE(marked, kSeries * kAlpha + 5.0 * deviation);
  EXPECT_GT(marked, 0);
}

}  // namespace
}  // namespace lightproof
