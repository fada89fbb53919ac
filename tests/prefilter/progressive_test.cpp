#include "lightproof/prefilter/progressive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/prefilter/specular_comparisons.h"

namespace lightproof {
namespace {

TEST(RunningMean, IsTheMeanOfAllSamples) {
  RunningMean<double> mean;
  EXPECT_EQ(mean.mean(), 0.0);
  mean.add(2.0, 3);
  mean.add(5.0, 1);
  EXPECT_EQ(mean.count(), 4U);
  EXPECT_DOUBLE_EQ(mean.mean(), 11.0 / 4.0);
  RunningMean<double> other;
  other.add(7.0, 4);
  mean.merge(other);
  mean.merge(RunningMean<double>());
  EXPECT_EQ(mean.count(), 8U);
  EXPECT_DOUBLE_EQ(mean.mean(), 39.0 / 8.0);
}

TEST(RunningMean, LosesNothingOfSmallSamplesAfterALargeOne) {
  RunningMean<double> mean;
  mean.add(1e16, 1);
  for (int i = 0; i < 1000; ++i) mean.add(1.0, 1);
  mean.add(-1e16, 1);
  EXPECT_EQ(mean.mean() * 1002.0, 1000.0);
}

// Samples of 1000 with probability 1/1000: their sum is counted in whole numbers.
TEST(RunningMean, IsExactOverAHundredMillionRareSamples) {
  const RandomStream stream("RunningMean.rare", 1);
  constexpr std::uint64_t kSamples = 100'000'000;
  constexpr std::size_t kBlock = 10'000;
  std::vector<double> s(kBlock);
  std::vector<double> t(kBlock);
  RunningMean<double> mean;
  PublishedBlend blend;
  std::uint64_t hits = 0;
  for (std::uint64_t first = 0; first < kSamples; first += kBlock) {
    fill_points(stream, first, s, t);
    for (const double u : s) {
      const bool hit = u < 1e-3;
      hits += hit ? 1 : 0;
      mean.add(hit ? 1000.0 : 0.0, 1);
      blend.add(hit ? 1000.0F : 0.0F, 1);
    }
  }
  const double exact = 1000.0 * static_cast<double>(hits) / static_cast<double>(kSamples);
  EXPECT_NEAR(mean.mean(), exact, 1e-15 * exact * 4.0) << "some roundings";
  // As published, in single precision: the old mean times 1 - f is rounded to it once f is below
  // 2^-25, at 3e7 samples, and from then on every hit adds its whole share.
  EXPECT_GT(std::abs(static_cast<double>(blend.mean()) / exact - 1.0), 0.01);
}

TEST(PublishedBlend, IsRightWhileThereAreFewSamples) {
  const PublishedComparison few = progressive_precision_comparison(10'000);
  // A rounding of 2^-24 in each of 1e4 blends.
  EXPECT_NEAR(few.published, few.exact, 2.0 * 1e4 * 0x1p-24 * few.exact);
  EXPECT_NEAR(few.corrected, few.exact, 1e-14);
}

TEST(SwappedBlend, KeepsABiasOfOneOverTheFactorial) {
  double factorial = 1.0;
  for (int frames = 1; frames <= 6; ++frames) {
    factorial *= frames;
    const PublishedComparison result = progressive_mean_comparison(frames);
    EXPECT_NEAR(result.published, 1.0 - 1.0 / factorial, 1e-15) << frames;
    EXPECT_NEAR(result.corrected, 1.0, 1e-15) << frames;
  }
}

/// The sum of the squared weights that the blend itself gives to frames: it is linear, so that the
/// weight of a frame is the mean of frames that are 1 there and else 0.
double squared_weights(int frames) {
  double sum = 0.0;
  for (int lit = 0; lit < frames; ++lit) {
    SwappedBlend blend;
    for (int frame = 0; frame < frames; ++frame) blend.add(frame == lit ? 1.0 : 0.0, 16);
    sum += blend.mean() * blend.mean();
  }
  return sum;
}

TEST(SwappedBlend, NeverConverges) {
  struct Printed {
    int frames;
    double squares;
  };
  for (const Printed& each :
       {Printed{2, 0.25}, Printed{5, 0.66}, Printed{20, 0.90}, Printed{100, 0.98}}) {
    EXPECT_NEAR(squared_weights(each.frames), each.squares, 5e-3) << "to two digits";
    const PublishedComparison result = progressive_variance_comparison(each.frames);
    EXPECT_NEAR(result.published, squared_weights(each.frames), 1e-14);
    EXPECT_DOUBLE_EQ(result.corrected, 1.0 / each.frames);
  }
}

}  // namespace
}  // namespace lightproof
