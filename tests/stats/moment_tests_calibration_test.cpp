#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/stats/moment_tests.h"
#include "uniformity.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kReplicates = 2000;
constexpr std::uint64_t kSamples = 4096;

// Moments of the uniform number on [0,1): mean 1/2, variance 1/12, fourth central moment 1/80.
constexpr double kMean = 0.5;
constexpr double kVariance = 1.0 / 12.0;
constexpr double kFourth = 1.0 / 80.0;

/// Two independent samples: of u.s, and of a quarter as many 3 u.t - 1, with the same mean and
/// nine times the variance.
struct Pair {
  Moments first;
  Moments second;

  Pair(const RandomStream& stream, double shift) {
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      const SquarePoint u = stream.point(i);
      first.add(u.s + shift);
      if (i % 4 == 0) second.add(3.0 * u.t - 1.0);
    }
  }
};

std::vector<double> p_values(const char* name, const std::function<ZTest(const Pair&)>& test,
                             double shift = 0.0) {
  const RandomStream stream(name, 1);
  std::vector<double> log10_p;
  for (std::uint64_t i = 0; i < kReplicates; ++i) {
    log10_p.push_back(test(Pair(stream.substream(i), shift)).log10_p);
  }
  return log10_p;
}

// 4096 uniform numbers (1024 for the second sample) are normal in the mean to a few 1e-5 of the
// distribution function, and in the variance, whose skewness is of order N^-1/2, to 1e-2: the
// bound of the test is 0.06.
TEST(MeanTestCalibration, PValuesAreUniform) {
  expect_uniform(p_values("MeanTestCalibration.PValuesAreUniform", [](const Pair& p) {
    return mean_test(p.first, {kMean, kVariance});
  }));
}

TEST(VarianceTestCalibration, PValuesAreUniform) {
  expect_uniform(p_values("VarianceTestCalibration.PValuesAreUniform", [](const Pair& p) {
    return variance_test(p.first, {kMean, kVariance}, kFourth);
  }));
}

TEST(WelchTestCalibration, PValuesAreUniform) {
  expect_uniform(p_values("WelchTestCalibration.PValuesAreUniform",
                          [](const Pair& p) { return welch_test(p.first, p.second); }));
}

TEST(MeanTestPower, DetectsAShiftOfTenStandardErrors) {
  const double shift = 10.0 * std::sqrt(kVariance / kSamples);
  // At 4.9 standard errors the test rejects; a deviate below -5.1 has a probability of 2e-7, so
  // that a miss among 2000 has 3e-4 and two have 1e-7.
  int missed = 0;
  const auto test = [](const Pair& p) { return mean_test(p.first, {kMean, kVariance}); };
  for (const double log10_p :
       p_values("MeanTestPower.DetectsAShiftOfTenStandardErrors", test, shift)) {
    if (log10_p > -6.0) ++missed;
  }
  EXPECT_LE(missed, 1);
}

}  // namespace
}  // namespace lightproof
