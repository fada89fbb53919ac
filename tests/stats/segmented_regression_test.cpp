#include "lightproof/stats/segmented_regression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

constexpr double kLevel = 0.01;

/// A standard normal number (Box and Muller).
double normal(const RandomStream& stream, std::uint64_t index) {
  const SquarePoint u = stream.point(index);
  return std::sqrt(-2.0 * std::log(1.0 - u.s)) * std::cos(2.0 * std::numbers::pi * u.t);
}

struct SlopeChange {
  double x;
  double change;  ///< of the slope
};

/// Points at x = 0, 1, … on a line of slope 0.1 that bends.
std::vector<DataPoint> bent(int count, const std::vector<SlopeChange>& breaks) {
  std::vector<DataPoint> points;
  for (int i = 0; i < count; ++i) {
    double y = 2.0 + 0.1 * i;
    for (const SlopeChange& segment_change : breaks)
      y += segment_change.change * std::max(i - segment_change.x, 0.0);
    points.push_back({1.0 * i, y});
  }
  return points;
}

std::vector<DataPoint> with_noise(std::vector<DataPoint> points, double sigma,
                                  const RandomStream& stream) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i].y += sigma * normal(stream, i);
  return points;
}

std::optional<SegmentedLine> line_of(const std::vector<DataPoint>& points, double level) {
  return segmented_lines({&points, 1}, level).front();
}

TEST(SegmentedLine, HasItsBreakpointWhereTheLineBends) {
  constexpr double kSigma = 0.01;
  for (const double change : {0.5, -0.5}) {
    const auto line =
        line_of(with_noise(bent(7, {{3.0, change}}), kSigma, RandomStream("bend", 1)), kLevel);
    ASSERT_TRUE(line);
    ASSERT_EQ(line->breakpoints.size(), 1U);
    EXPECT_EQ(line->breakpoints[0].point, 3U);
    // Either slope is the least-squares one of three points and more, of standard error at most
    // sigma / sqrt(2); five of these are beyond chance.
    EXPECT_NEAR(line->slope, 0.1, 5.0 * kSigma / std::numbers::sqrt2);
    EXPECT_NEAR(line->breakpoints[0].slope_after, 0.1 + change, 5.0 * kSigma / std::numbers::sqrt2);
    EXPECT_LE(line->p_value, kLevel);
  }
}

TEST(SegmentedLine, HasBothBreakpointsOfWhatRisesInBetween) {
  const auto line = line_of(
      with_noise(bent(11, {{3.0, 0.9}, {6.0, -0.8}}), 0.05, RandomStream("both", 1)), kLevel);
  ASSERT_TRUE(line);
  ASSERT_EQ(line->breakpoints.size(), 2U);
  EXPECT_EQ(line->breakpoints[0].point, 3U);
  EXPECT_EQ(line->breakpoints[1].point, 6U);
  // Three points and more lie on each piece: 0.05 / sqrt(2), five times.
  EXPECT_NEAR(line->slope, 0.1, 0.18);
  EXPECT_NEAR(line->breakpoints[0].slope_after, 1.0, 0.18);
  EXPECT_NEAR(line->breakpoints[1].slope_after, 0.2, 0.18);
}

TEST(SegmentedLine, WithoutNoiseIsFittedExactly) {
  const auto one = line_of(bent(6, {{2.0, 1.0}}), kLevel);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->breakpoints.size(), 1U);
  EXPECT_EQ(one->breakpoints[0].point, 2U);
  EXPECT_NEAR(one->slope, 0.1, 1e-12);
  EXPECT_NEAR(one->breakpoints[0].slope_after, 1.1, 1e-12);
  const auto two = line_of(bent(9, {{2.0, 1.0}, {5.0, -1.5}}), kLevel);
  ASSERT_TRUE(two);
  ASSERT_EQ(two->breakpoints.size(), 2U);
  EXPECT_NEAR(two->slope, 0.1, 1e-12);
  EXPECT_NEAR(two->breakpoints[0].slope_after, 1.1, 1e-12);
  EXPECT_NEAR(two->breakpoints[1].slope_after, -0.4, 1e-12);
}

TEST(SegmentedLine, IsNoneWhereRoundingAloneBends) {
  for (int count = 5; count < 20; ++count) {
    EXPECT_FALSE(line_of(bent(count, {{0.0, 0.2}}), kLevel)) << "straight";
  }
  EXPECT_FALSE(line_of(bent(9, {{0.0, -0.1}}), kLevel)) << "a constant";
}

TEST(SegmentedLine, IsNoneOfFourPointsAndOfALastOneThatIsOff) {
  EXPECT_FALSE(line_of({}, kLevel));
  EXPECT_FALSE(line_of(bent(4, {{1.0, 1.0}}), kLevel));
  for (int count = 6; count < 12; ++count) {
    EXPECT_FALSE(line_of(bent(count, {{count - 2.0, 1.0}}), kLevel)) << count;
  }
}

TEST(SegmentedLine, HasItsBreakpointAmongRepeatedX) {
  std::vector<DataPoint> twice;
  for (const DataPoint& point : bent(6, {{2.0, 1.0}})) twice.insert(twice.end(), 2, point);
  const auto line = line_of(twice, kLevel);
  ASSERT_TRUE(line);
  EXPECT_EQ(twice[line->breakpoints[0].point].x, 2.0);
  EXPECT_FALSE(line_of(std::vector<DataPoint>(9, DataPoint{1.0, 1.0}), kLevel));
}

TEST(SegmentedLine, IsCalledOfStraightOnesAsOftenAsItsLevelSays) {
  constexpr int kLines = 100;
  constexpr double kFifth = 0.2;
  const RandomStream stream("straight", 1);
  for (const int count : {5, 11}) {
    int called = 0;
    for (std::uint64_t i = 0; i < kLines; ++i) {
      if (line_of(with_noise(bent(count, {}), 1.0, stream.substream(i)), kFifth)) ++called;
    }
    // Binomial, within five standard deviations.
    EXPECT_NEAR(called, kLines * kFifth, 5.0 * std::sqrt(kLines * kFifth * (1.0 - kFifth)))
        << count;
  }
}

/// A page of so many straight lines of eleven points that scatter.
std::vector<std::vector<DataPoint>> straight_lines(std::size_t count, const RandomStream& stream) {
  std::vector<std::vector<DataPoint>> lines;
  for (std::size_t i = 0; i < count; ++i) {
    lines.push_back(with_noise(bent(11, {}), 1.0, stream.substream(stream.number() + i)));
  }
  return lines;
}

// At this level each, one of eleven lines would bend on nine pages of ten.
TEST(SegmentedLines, OfAPageAreCalledAsOftenAsItsLevelSays) {
  constexpr int kPages = 100;
  constexpr std::size_t kLines = 11;
  constexpr double kFifth = 0.2;
  const RandomStream stream("straight pages", 1);
  int pages = 0;
  for (std::uint64_t page = 0; page < kPages; ++page) {
    const auto found =
        segmented_lines(straight_lines(kLines, stream.substream(kLines * page)), kFifth);
    pages += std::ranges::any_of(found, [](const auto& line) { return line.has_value(); }) ? 1 : 0;
  }
  // Binomial, within five standard deviations.
  const double deviation = std::sqrt(kPages * kFifth * (1.0 - kFifth));
  EXPECT_LE(pages, kPages * kFifth + 5.0 * deviation);
  EXPECT_GT(pages, 0);
}

TEST(SegmentedLines, AreFoundAmongStraightOnes) {
  auto lines = straight_lines(10, RandomStream("straight among", 1));
  lines.push_back(with_noise(bent(11, {{5.0, 0.9}}), 0.05, RandomStream("bent among", 1)));
  const auto found = segmented_lines(lines, kLevel);
  ASSERT_EQ(found.size(), 11U);
  ASSERT_TRUE(found.back());
  EXPECT_EQ(found.back()->breakpoints[0].point, 5U);
}

}  // namespace
}  // namespace lightproof
