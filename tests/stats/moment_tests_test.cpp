#include "lightproof/stats/moment_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

Moments moments_of(const std::vector<double>& values) {
  Moments moments;
  for (const double x : values) moments.add(x);
  return moments;
}

/// `count` values of this mean, half of them `deviation` above, half below.
Moments two_values(int count, double mean, double deviation) {
  Moments moments;
  for (int i = 0; i < count; ++i) moments.add(mean + (i % 2 == 0 ? deviation : -deviation));
  return moments;
}

// A few roundings of numbers of order 1.
constexpr double kRounding = 1e-13;

TEST(MeanTest, OfAHandComputedSample) {
  // Mean 11 of 100 against 10 with variance 25: standard error 0.5.
  const ZTest test = mean_test(two_values(100, 11.0, 3.0), {10.0, 25.0});
  EXPECT_NEAR(test.z, 2.0, kRounding);
  EXPECT_NEAR(test.effect, 0.1, kRounding);
  EXPECT_EQ(test.log10_p, log10_normal_tails(test.z));
  // P(|Z| > 2) from the table.
  EXPECT_NEAR(test.log10_p, std::log10(0.04550026389635842), kRounding);
}

TEST(MeanTest, UsesTheExactVarianceAndKeepsTheSign) {
  const ZTest wide = mean_test(two_values(100, 9.0, 1000.0), {10.0, 25.0});
  EXPECT_NEAR(wide.z, -2.0, 1e-11) << "cancellation of 1000s";
  EXPECT_NEAR(wide.effect, -0.1, 1e-12);
}

TEST(MeanTest, DoesNotDependOnTheScale) {
  const ZTest unit = mean_test(two_values(100, 11.0, 3.0), {10.0, 25.0});
  for (const double scale : {0x1p-60, 0x1p60}) {
    const ZTest scaled =
        mean_test(two_values(100, 11.0 * scale, 3.0 * scale), {10.0 * scale, 25.0 * scale * scale});
    EXPECT_EQ(scaled.z, unit.z);
    EXPECT_EQ(scaled.log10_p, unit.log10_p);
    EXPECT_EQ(scaled.effect, unit.effect);
  }
}

TEST(MeanTest, RejectsAMeanThatIsOffByTwoOnADimMap) {
  // A floor of 1e-5 under the variance would accept this one.
  const ZTest test = mean_test(two_values(10000, 2e-6, 1e-6), {1e-6, 1e-12});
  EXPECT_NEAR(test.z, 100.0, 1e-8);
  EXPECT_LT(test.log10_p, -1000.0);
}

TEST(VarianceTest, OfAHandComputedSample) {
  // The sample variance of 1, 2, 3, 6 is 14/3; sqrt((mu4 - sigma^4)/N) = sqrt((25 - 9)/4) = 2.
  const ZTest test = variance_test(moments_of({1, 2, 3, 6}), {2.0, 3.0}, 25.0);
  EXPECT_NEAR(test.z, 5.0 / 6.0, kRounding);
  EXPECT_NEAR(test.effect, 5.0 / 9.0, kRounding);
  EXPECT_EQ(test.log10_p, log10_normal_tails(test.z));
}

TEST(VarianceTest, AcceptsTheVarianceItself) {
  EXPECT_EQ(variance_test(moments_of({1, 2, 3}), {2.0, 1.0}, 3.0).z, 0.0);
  EXPECT_EQ(variance_test(moments_of({1, 2, 3}), {2.0, 1.0}, 3.0).log10_p, 0.0);
}

TEST(WelchTest, OfAHandComputedPair) {
  // Means 3 and 2, variances 14/3 of four and 1 of three: 7/6 + 1/3 = 3/2.
  const ZTest test = welch_test(moments_of({1, 2, 3, 6}), moments_of({1, 2, 3}));
  EXPECT_NEAR(test.z, 1.0 / std::sqrt(1.5), kRounding);
  EXPECT_NEAR(test.effect, 0.5, kRounding);
  EXPECT_EQ(test.log10_p, log10_normal_tails(test.z));
  EXPECT_NEAR(welch_test(moments_of({1, 2, 3}), moments_of({1, 2, 3, 6})).z, -test.z, kRounding);
}

TEST(WelchTest, OfTwoConstantsSeesOnlyWhetherTheyDiffer) {
  const Moments ones = moments_of({1, 1, 1});
  EXPECT_EQ(welch_test(ones, ones).log10_p, 0.0);
  EXPECT_EQ(welch_test(ones, moments_of({2, 2, 2})).log10_p, -INFINITY);
}

// One sample in 1e5 is 1e5 times as bright as the mean: X = 1/s with probability s, else 0. A
// single hit among 1000 is 10 standard errors, and happens once in a hundred runs.
TEST(TailsOfMean, DoNotTakeARareBrightSampleForADefect) {
  const double s = 1e-5;
  const ExactMoments moments = {1.0, 1.0 / s - 1.0, 1.0 / s};
  const double z = (100.0 - 1.0) / std::sqrt(moments.variance / 1000.0);
  EXPECT_GT(z, 9.0);
  EXPECT_LT(log10_normal_tails(z), -18.0);
  EXPECT_GT(log10_tails_of_mean(z, 1000.0, moments), -2.0);
}

TEST(TailsOfMean, FallWithTheDeviation) {
  const ExactMoments moments = {1.0, 1e5 - 1.0, 1e5};
  for (const double samples : {1e5, 1e7, 1e8, 1e10}) {
    double last = 0.0;
    for (int i = 1; i < 2000; ++i) {
      const double tail = log10_tails_of_mean(0.01 * i, samples, moments);
      ASSERT_LE(tail, last) << samples << ", z = " << 0.01 * i;
      last = tail;
    }
  }
}

TEST(DetectableFactor, IsSeenWithTheStatedPowerHoweverSkewedTheDistribution) {
  // Rare samples of 1/s, else 0: their number is Poisson, near enough.
  const double s = 1e-5;
  const ExactMoments moments = {1.0, 1.0 / s - 1.0, 1.0 / s};
  for (const double samples : {2e6, 1e7, 1e8, 1e10}) {
    const double factor = minimum_detectable_factor(1e-6, 0.99, samples, moments, 1.0);
    ASSERT_TRUE(std::isfinite(factor)) << samples;
    const double mean = samples * s;
    const auto is_rejected = [&](double count) {
      const double z = (factor * count / mean - 1.0) / std::sqrt(moments.variance / samples);
      return log10_tails_of_mean(z, samples, moments) < -6.0;
    };
    // The fewest that are rejected as too many: all from there on are.
    double fewest = std::floor(mean);
    while (fewest > 0.0 && is_rejected(fewest - 1.0) && factor * (fewest - 1.0) > mean) --fewest;
    while (!is_rejected(fewest)) ++fewest;
    const double missed = std::pow(10.0, log10_poisson_lower(fewest - 1.0, mean));
    EXPECT_LT(missed, 0.01 * 1.1) << samples << " samples, factor " << factor;
    EXPECT_GT(missed, 0.001) << samples << " samples, factor " << factor;
  }
  EXPECT_TRUE(std::isinf(minimum_detectable_factor(1e-6, 0.99, 1e5, moments, 1.0)));
}

// What everything passes is passed without any deviation.
TEST(DetectableFactor, OfALevelOfOneHoldsPowerAlone) {
  const ExactMoments moments = {1.0, 1.0, 5.0};
  const double error = 1e-2;
  EXPECT_NEAR(minimum_detectable_factor(1.0, 0.5, 1e4, moments, 1.0), 1.0, 1e-9);
  EXPECT_NEAR(minimum_detectable_factor(1.0, 0.99, 1e4, moments, 1.0), 1.0 / (1.0 - 2.3263 * error),
              1e-6);
}

// Never below the exact tail: counts of the same distribution are binomial, near enough Poisson.
// And no farther above it than a bound by exponents must be.
TEST(TailsOfMean, BoundTheExactTailFromAbove) {
  const double s = 1e-5;
  const ExactMoments moments = {1.0, 1.0 / s - 1.0, 1.0 / s};
  for (const double samples : {1e3, 1e5, 1e6, 1e7}) {
    const double mean = samples * s;
    for (double count = std::ceil(mean) + 1.0; count < 4.0 * mean + 20.0;
         count += 1.0 + std::floor(mean / 4.0)) {
      const double z = (count / mean - 1.0) / std::sqrt(moments.variance / samples);
      const double tail = log10_tails_of_mean(z, samples, moments);
      const double exact = log10_poisson_upper(count, mean);
      EXPECT_GE(tail, exact - 0.31) << samples << ", " << count;  // a factor of two
      // Chernoff's bound on a Poisson tail, over the probability of the count itself (Stirling).
      const double slack = 0.5 * std::log10(2.0 * std::numbers::pi * count) + 0.31;
      EXPECT_LE(tail, exact + slack + 0.04) << samples << ", " << count;
    }
  }
}

TEST(TailsOfMean, AreNormalWhereSkewnessDoesNotMatter) {
  const ExactMoments moments = {1.0, 1.0, 3.0};
  EXPECT_EQ(log10_tails_of_mean(6.0, 1e6, moments), log10_normal_tails(6.0));
  EXPECT_EQ(log10_tails_of_mean(6.0, 10.0, {1.0, 1.0}), log10_normal_tails(6.0));
}

TEST(TwoMeans, OfAHandComputedPair) {
  // Means 11 and 10 with exact variances 9 and 16 over 100 and 50 samples.
  const ZTest test = two_mean_test(two_values(100, 11.0, 1.0), {10.0, 9.0},
                                   two_values(50, 10.0, 2.0), {10.0, 16.0});
  EXPECT_NEAR(test.z, 1.0 / std::sqrt(0.09 + 0.32), 1e-12);
}

}  // namespace
}  // namespace lightproof
