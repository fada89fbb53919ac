#include "lightproof/core/moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"

namespace lightproof {
namespace {

constexpr std::size_t kCount = 100000;

/// Mean and central moments by two passes in 64 bits of precision.
struct TwoPass {
  long double mean = 0.0L;
  long double variance = 0.0L;
  long double fourth = 0.0L;

  explicit TwoPass(const std::vector<double>& values) {
    const auto n = static_cast<long double>(values.size());
    for (const double x : values) mean += static_cast<long double>(x) / n;
    for (const double x : values) {
      const long double square = (x - mean) * (x - mean);
      variance += square / (n - 1.0L);
      fourth += square * square / n;
    }
  }
};

/// Skewed as radiance is: log-uniform over six decades.
std::vector<double> skewed_values() {
  const RandomStream stream("Moments.skewed", 1);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < kCount; ++i)
    values.push_back(std::pow(10.0, 6.0 * stream.point(i).s));
  return values;
}

Moments moments_of(std::span<const double> values) {
  Moments moments;
  for (const double x : values) moments.add(x);
  return moments;
}

void expect_near(const Moments& measured, const TwoPass& exact, double relative) {
  const auto mean = static_cast<double>(exact.mean);
  const auto variance = static_cast<double>(exact.variance);
  const auto fourth = static_cast<double>(exact.fourth);
  EXPECT_NEAR(measured.mean(), mean, relative * std::abs(mean));
  EXPECT_NEAR(measured.variance(), variance, relative * variance);
  EXPECT_NEAR(measured.fourth_central(), fourth, relative * fourth);
  EXPECT_NEAR(measured.standard_error(),
              std::sqrt(variance / static_cast<double>(measured.count())),
              relative * std::sqrt(variance));
}

// n additions of numbers of one sign are off by n eps at most; mean/sigma is below 1 here.
constexpr double kSumError = kCount * 2.3e-16;

std::array<std::uint64_t, 4> bits(const Moments& moments) {
  return {moments.count(), std::bit_cast<std::uint64_t>(moments.mean()),
          std::bit_cast<std::uint64_t>(moments.variance()),
          std::bit_cast<std::uint64_t>(moments.fourth_central())};
}

TEST(Moments, OfNothingAndOfOneAreZero) {
  Moments moments;
  EXPECT_EQ(moments.count(), 0U);
  EXPECT_EQ(moments.mean(), 0.0);
  EXPECT_EQ(moments.variance(), 0.0);
  EXPECT_EQ(moments.fourth_central(), 0.0);
  EXPECT_EQ(moments.standard_error(), 0.0);
  moments.add(3.5);
  EXPECT_EQ(moments.count(), 1U);
  EXPECT_EQ(moments.mean(), 3.5);
  EXPECT_EQ(moments.variance(), 0.0);
  EXPECT_EQ(moments.fourth_central(), 0.0);
}

TEST(Moments, OfAHandComputedSample) {
  // Deviations from 3 are -2, -1, 0, 3: squares sum to 14, fourth powers to 98.
  const Moments moments = moments_of(std::array{1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(moments.mean(), 3.0);
  EXPECT_DOUBLE_EQ(moments.variance(), 14.0 / 3.0);
  EXPECT_DOUBLE_EQ(moments.fourth_central(), 98.0 / 4.0);
  EXPECT_DOUBLE_EQ(moments.standard_error(), std::sqrt(14.0 / 12.0));
}

TEST(Moments, OfEqualValuesHaveNoVariance) {
  const Moments moments = moments_of(std::vector<double>(1000, 0.1));
  EXPECT_EQ(moments.mean(), 0.1);
  EXPECT_EQ(moments.variance(), 0.0);
  EXPECT_EQ(moments.fourth_central(), 0.0);
}

TEST(Moments, AgreeWithTwoPassesOnSkewedData) {
  const std::vector<double> values = skewed_values();
  expect_near(moments_of(values), TwoPass(values), kSumError);
}

TEST(Moments, MergeAgreesWithAdd) {
  const std::vector<double> values = skewed_values();
  const TwoPass exact(values);
  // The parts differ in size and, since the values are sorted in half of the cases, in mean.
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& order : {values, sorted}) {
    for (const std::size_t chunk :
         {std::size_t{1}, std::size_t{7}, std::size_t{1000}, kCount - 1}) {
      Moments merged;
      for (std::size_t begin = 0; begin < kCount; begin += chunk) {
        const std::size_t size = std::min(chunk, kCount - begin);
        merged.merge(moments_of(std::span(order).subspan(begin, size)));
      }
      EXPECT_EQ(merged.count(), kCount);
      expect_near(merged, exact, kSumError);
    }
  }
}

TEST(Moments, ManyAtOnceAgreeWithOneByOne) {
  const std::vector<double> values = skewed_values();
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{8},
                                  std::size_t{9}, std::size_t{1023}, kCount}) {
    const auto some = std::span(values).first(count);
    Moments at_once;
    at_once.add(some);
    EXPECT_EQ(at_once.count(), count);
    if (count > 1) expect_near(at_once, TwoPass({some.begin(), some.end()}), kSumError);
    if (count == 1) {
      EXPECT_EQ(bits(at_once), bits(moments_of(some)));
    }
    // With what comes before and after: the third moment shows in the fourth of the whole.
    Moments parts = moments_of(some);
    parts.add(std::span(values).subspan(count));
    EXPECT_EQ(parts.count(), kCount);
    expect_near(parts, TwoPass(values), kSumError);
  }
  Moments none;
  none.add(std::span<const double>());
  EXPECT_EQ(bits(none), bits(Moments()));
}

TEST(Moments, MergeWithNothingChangesNoBit) {
  const Moments some = moments_of(std::array{0.1, 0.7, 1e3});
  Moments left = some;
  left.merge(Moments());
  EXPECT_EQ(bits(left), bits(some));
  Moments right;
  right.merge(some);
  EXPECT_EQ(bits(right), bits(some));
}

TEST(Moments, SurviveALargeOffset) {
  const RandomStream stream("Moments.SurviveALargeOffset", 1);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < kCount; ++i) values.push_back(1e9 + stream.point(i).s);
  Moments merged;
  for (std::size_t begin = 0; begin < kCount; begin += 1000) {
    merged.merge(moments_of(std::span(values).subspan(begin, 1000)));
  }
  // The mean is kept to a few ulp of 1e9, 1.2e-7 each, or 4e-7 of the standard deviation 0.29; the
  // fourth moment takes four times that. A sum of squares would be off by eps 1e18 = 220.
  expect_near(moments_of(values), TwoPass(values), 1e-5);
  expect_near(merged, TwoPass(values), 1e-5);
}

TEST(Moments, MergedInFixedOrderHaveTheSameBitsForAnyThreads) {
  const std::vector<double> values = skewed_values();
  const auto total = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<Moments> chunks(100);
    parallel_for(chunks.size(), [&](std::size_t i) {
      chunks[i] = moments_of(std::span(values).subspan(1000 * i, 1000));
    });
    Moments sum;
    for (const Moments& chunk : chunks) sum.merge(chunk);
    return bits(sum);
  };
  const auto single = total(1);
  for (const int threads : {2, 3, 0}) EXPECT_EQ(total(threads), single) << threads;
}

}  // namespace
}  // namespace lightproof
