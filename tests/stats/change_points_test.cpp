#include "lightproof/stats/change_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lightproof/core/random.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

double normal(const RandomStream& stream, std::uint64_t index) {
  return normal_quantile(stream.point(index).s + 0x1p-54);
}

/// A log-normal level of 100 times `factor`, of independent values with this spread.
std::vector<double> level(std::uint64_t substream, std::size_t count, double factor = 1.0,
                          double spread = 0.02) {
  const RandomStream stream("stats/change-points", 1, substream);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < count; ++i) {
    values.push_back(100.0 * factor * std::exp(spread * normal(stream, i)));
  }
  return values;
}

std::vector<double> joined(std::vector<double> values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

std::vector<ChangePoint> changes_of(const std::vector<double>& values,
                                    const ChangeRule& rule = {}) {
  return change_points({&values, 1}, rule).front();
}

TEST(ChangePoints, StandWhereTheLevelChanges) {
  const auto series = joined(joined(level(1, 15), level(2, 12, 1.3)), level(3, 15, 1.1));
  const auto changes = changes_of(series);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].first, 15U);
  EXPECT_EQ(changes[1].first, 27U);
  // Medians of a dozen values with a spread of 2 % are within 5 %.
  EXPECT_NEAR(changes[0].ratio, 1.3, 0.05);
  EXPECT_NEAR(changes[1].ratio, 1.1 / 1.3, 0.05);
  EXPECT_LT(changes[0].log10_p, std::log10(0.05));
}

// However short one of the levels is beside the other.
TEST(ChangePoints, StandNearTheEndsToo) {
  for (const std::size_t at : {kShortestLevel, 60 - kShortestLevel}) {
    const auto changes = changes_of(joined(level(5, at), level(6, 60 - at, 1.3)));
    ASSERT_EQ(changes.size(), 1U) << at;
    EXPECT_EQ(changes[0].first, at);
  }
}

TEST(ChangePoints, OfMoreThanTwoAreFoundOneInsideTheOther) {
  std::vector<double> series;
  const std::vector<double> factors = {1.0, 1.5, 1.0, 1.5};
  for (std::size_t i = 0; i < factors.size(); ++i) {
    series = joined(series, level(10 + i, 24, factors[i], 0.005));
  }
  const auto changes = changes_of(series);
  ASSERT_EQ(changes.size(), 3U);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(changes[i].first, 24 * (i + 1));
    EXPECT_NEAR(changes[i].ratio, factors[i + 1] / factors[i], 0.02);
  }
}

// On either side of either step most values are alike: only the levels beside it tell.
TEST(ChangePoints, OfASlowSpellBetweenEqualLevelsAreFound) {
  const auto series = joined(joined(level(21, 40, 1.0, 0.005), level(22, 6, 1.2, 0.005)),
                             level(23, 40, 1.0, 0.005));
  const auto changes = changes_of(series);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].first, 40U);
  EXPECT_EQ(changes[1].first, 46U);
  EXPECT_NEAR(changes[0].ratio, 1.2, 0.02);
  EXPECT_NEAR(changes[1].ratio, 1.0 / 1.2, 0.02);
}

TEST(ChangePoints, OfWhatDoesNotScatterAreFound) {
  const auto series = joined(std::vector<double>(6, 100.0), std::vector<double>(6, 110.0));
  ASSERT_EQ(changes_of(series).size(), 1U);
  EXPECT_EQ(changes_of(series)[0].first, 6U);
  EXPECT_TRUE(changes_of(std::vector<double>(12, 0.1)).empty());
}

TEST(ChangePoints, BelowTheLeastRatioAreNone) {
  // Six times the spread, 3 %.
  const auto series = joined(level(4, 40, 1.0, 0.005), level(5, 40, 1.03, 0.005));
  EXPECT_TRUE(changes_of(series).empty());
  EXPECT_EQ(changes_of(series, {0.05, 1.0}).size(), 1U);
}

TEST(ChangePoints, NeedTwoLevelsOfFiveValues) {
  EXPECT_TRUE(change_points({}, {}).empty());
  EXPECT_TRUE(changes_of({}).empty());
  EXPECT_TRUE(changes_of({1.0}).empty());
  EXPECT_TRUE(changes_of(joined(level(6, 4), level(7, 5, 2.0))).empty());
  EXPECT_EQ(changes_of(joined(level(6, 5), level(7, 5, 2.0))).size(), 1U);
}

/// Series of one level on a page.
constexpr std::size_t kBenchmarks = 30;
constexpr std::size_t kSessions = 40;

/// A state that lasts: errors of standard deviation 1 with this correlation between neighbours.
std::vector<double> lasting(double correlation, const RandomStream& stream) {
  std::vector<double> errors = {normal(stream, 0)};
  for (std::uint64_t i = 1; i < kSessions; ++i) {
    errors.push_back(correlation * errors.back() +
                     std::sqrt(1.0 - correlation * correlation) * normal(stream, i));
  }
  return errors;
}

std::vector<std::vector<double>> page_of(double correlation, std::uint64_t number) {
  const RandomStream stream("stats/pages", 1);
  std::vector<std::vector<double>> page(kBenchmarks);
  for (std::size_t k = 0; k < kBenchmarks; ++k) {
    for (const double error : lasting(correlation, stream.substream(kBenchmarks * number + k))) {
      page[k].push_back(100.0 * std::exp(0.02 * error));
    }
  }
  return page;
}

bool any(const std::vector<std::vector<ChangePoint>>& changes) {
  return std::ranges::any_of(changes, [](const auto& one) { return !one.empty(); });
}

constexpr int kPages = 100;
constexpr ChangeRule kAnyRatio = {0.05, 1.0};
/// Of a binomial number of pages, five standard deviations above the mean.
const double kMostPages = kPages * 0.05 + 5.0 * std::sqrt(kPages * 0.05 * 0.95);

class Correlation : public testing::TestWithParam<double> {};

TEST_P(Correlation, OfSessionsMakesNoMoreFalseAlarmsOnAPageThanAlphaSays) {
  int marked = 0;
  for (std::uint64_t i = 0; i < kPages; ++i) {
    marked += any(change_points(page_of(GetParam(), i), kAnyRatio)) ? 1 : 0;
  }
  EXPECT_LE(marked, kMostPages);
}

INSTANTIATE_TEST_SUITE_P(OfNeighbours, Correlation, testing::Values(0.0, 0.5, 0.75, 0.9),
                         [](const auto& test) {
                           return std::to_string(static_cast<int>(100.0 * test.param));
                         });

TEST(ChangePoints, AreNotMadeByOutliers) {
  int marked = 0;
  const RandomStream stream("stats/outliers", 1);
  for (std::uint64_t i = 0; i < kPages; ++i) {
    auto page = page_of(0.0, i);
    for (std::size_t k = 0; k < page.size(); ++k) {
      for (std::size_t s = 0; s < kSessions; ++s) {
        // One session in ten is slow by half.
        if (stream.substream(kBenchmarks * i + k).point(s).s < 0.1) page[k][s] *= 1.5;
      }
    }
    marked += any(change_points(page, kAnyRatio)) ? 1 : 0;
  }
  EXPECT_LE(marked, kMostPages);
}

// A step of nine spreads, among 29 series that keep their level.
TEST(ChangePoints, OfTwentyPercentAreFoundOnAPage) {
  int found = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    auto page = page_of(0.0, i);
    for (std::size_t s = 24; s < kSessions; ++s) page[7][s] *= 1.2;
    const auto changes = change_points(page, {});
    found += changes[7].size() == 1 && changes[7][0].first == 24 ? 1 : 0;
  }
  EXPECT_GE(found, 18);
}

}  // namespace
}  // namespace lightproof
