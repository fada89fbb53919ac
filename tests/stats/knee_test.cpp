#include "lightproof/stats/knee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

constexpr double kLevel = 0.01;

/// A standard normal number (Box and Muller).
double normal(const RandomStream& stream, std::uint64_t index) {
  const SquarePoint u = stream.point(index);
  return std::sqrt(-2.0 * std::log(1.0 - u.s)) * std::cos(2.0 * std::numbers::pi * u.t);
}

/// Points at x = 0, 1, … on a line of slope 0.1 that bends at `knee` to slope 0.1 + change.
std::vector<LinePoint> bent(int count, double knee, double change) {
  std::vector<LinePoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({1.0 * i, 2.0 + 0.1 * i + change * std::max(i - knee, 0.0)});
  }
  return points;
}

std::vector<LinePoint> with_noise(std::vector<LinePoint> points, double sigma,
                                  const RandomStream& stream) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i].y += sigma * normal(stream, i);
  return points;
}

TEST(Knee, IsFoundWhereItWasPlanted) {
  constexpr double kSigma = 0.01;
  for (const double change : {0.5, -0.5}) {
    const auto knee =
        find_knee(with_noise(bent(7, 3.0, change), kSigma, RandomStream("planted", 1)), kLevel);
    ASSERT_TRUE(knee);
    EXPECT_EQ(knee->point, 3U);
    // Either slope is the least-squares one of three points and more, of standard error at most
    // sigma / sqrt(2); five of these are beyond chance.
    EXPECT_NEAR(knee->slope_before, 0.1, 5.0 * kSigma / std::numbers::sqrt2);
    EXPECT_NEAR(knee->slope_after, 0.1 + change, 5.0 * kSigma / std::numbers::sqrt2);
    EXPECT_LE(knee->p_value, kLevel);
  }
}

TEST(Knee, WithoutNoiseIsCertain) {
  const auto knee = find_knee(bent(6, 2.0, 1.0), kLevel);
  ASSERT_TRUE(knee);
  EXPECT_EQ(knee->point, 2U);
  EXPECT_NEAR(knee->slope_after - knee->slope_before, 1.0, 1e-12);
}

TEST(Knee, IsNoneOfAStraightLineWhoseRoundingAloneBends) {
  for (int count = 5; count < 20; ++count) EXPECT_FALSE(find_knee(bent(count, 0.0, 0.2), kLevel));
  EXPECT_FALSE(find_knee(bent(9, 0.0, -0.1), kLevel)) << "a constant";
}

TEST(Knee, IsNoneOfFourPointsAndOfASingleOneThatIsOff) {
  EXPECT_FALSE(find_knee(bent(4, 1.0, 1.0), kLevel));
  EXPECT_FALSE(find_knee({}, kLevel));
  EXPECT_FALSE(find_knee(bent(6, 4.0, 1.0), kLevel)) << "the last one alone";
  EXPECT_FALSE(find_knee(bent(7, 5.0, 1.0), kLevel)) << "the last one alone";
}

TEST(Knee, IsFoundAmongRepeatedPlaces) {
  std::vector<LinePoint> twice;
  for (const LinePoint& point : bent(6, 2.0, 1.0)) twice.insert(twice.end(), 2, point);
  const auto knee = find_knee(twice, kLevel);
  ASSERT_TRUE(knee);
  EXPECT_EQ(twice[knee->point].x, 2.0);
  EXPECT_FALSE(find_knee(std::vector<LinePoint>(9, LinePoint{1.0, 1.0}), kLevel));
}

TEST(Knee, IsCalledOfNoiseAsOftenAsItsLevelAllows) {
  constexpr int kLines = 20000;
  const RandomStream stream("straight", 1);
  for (const int count : {5, 6, 7, 11}) {
    int called = 0;
    for (std::uint64_t i = 0; i < kLines; ++i) {
      if (find_knee(with_noise(bent(count, 0.0, 0.0), 1.0, stream.substream(i)), kLevel)) ++called;
    }
    // Each place alone has its share of the level exactly, so the whole lies between one share and
    // all of them: a binomial number, within five standard deviations.
    const double most = kLines * kLevel;
    const double least = most / (count - 4);
    EXPECT_LE(called, most + 5.0 * std::sqrt(most)) << count;
    EXPECT_GE(called, least - 5.0 * std::sqrt(least)) << count;
    RecordProperty("called_of_" + std::to_string(count), called);
  }
}

}  // namespace
}  // namespace lightproof
