// Stated powers and detectable effects, each against simulated samples of a distribution that is
// off by as much.
#include "power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/sequential.h"
#include "lightproof/stats/tails.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

constexpr double kLevel = 1e-3;
const double kLog10Level = std::log10(kLevel);
constexpr int kReplicates = 2000;
constexpr std::uint64_t kSamples = 4096;
constexpr double kRootOfSamples = 64.0;
/// Cells that uniformity is tested over: an even number, so that their edges have the middle.
constexpr std::size_t kCells = 1024;

constexpr double kPowers[] = {0.6, 0.9, 0.99};

std::vector<double> cells_of(double (*cumulative)(double u, double strength), double strength) {
  std::vector<double> probability;
  const auto edge = [&](std::size_t i) {
    return cumulative(static_cast<double>(i) / kCells, strength);
  };
  for (std::size_t i = 0; i < kCells; ++i) probability.push_back(edge(i + 1) - edge(i));
  return probability;
}

/// A tent: the density is 1 + 2 d up to 1/2 and 1 - 2 d from there on. Kuiper's distance is d, in
/// the middle, where a share of 1/2 scatters most.
double tent(double u, double d) { return u + 2.0 * d * std::min(u, 1.0 - u); }

/// A linear density: the deviation d sqrt(6) u (1-u) is the first eigenfunction of Anderson and
/// Darling's kernel, of variance 1/2, and d the root of its weighted mean square.
double parabola(double u, double d) { return u + std::sqrt(6.0) * d * u * (1.0 - u); }

int kuiper_rejections(double distance) {
  const CellDistribution distribution(cells_of(tent, distance));
  return count_rejections("KuiperPower", kReplicates, [&](const RandomStream& stream) {
    return kuiper_test(distribution.counts(stream, kSamples)).log10_p < kLog10Level;
  });
}

int anderson_darling_rejections(double distance) {
  const CellDistribution distribution(cells_of(parabola, distance));
  return count_rejections("AndersonDarlingPower", kReplicates, [&](const RandomStream& stream) {
    return anderson_darling_test(distribution.counts(stream, kSamples)).log10_p < kLog10Level;
  });
}

/// The statistic whose p-value is the level.
template <class Tail>
double critical_value(const Tail& tail) {
  double v = 0.1;
  while (tail(v) > kLog10Level) v += 1e-4;
  return v;
}

// The distance is at least the deviation at the middle, a normal of standard deviation 1/2 around
// d sqrt N: hence the least power. It is more where the empirical distribution rises above its
// value at the middle, and falls below that at the ends: around both a Brownian motion with a drift
// of 2 d sqrt N on either side, whose supremum is exponential with the mean 1 / (4 d sqrt N), the
// larger of two of them 3/2 of that. Both together, 3 / (4 d sqrt N), raise the power to that of a
// distance greater by it, at most: the normal distribution is concave above its mean.
TEST(KuiperPower, OfTheDetectableDistanceIsAsStated) {
  const double critical = critical_value(log10_kuiper_tail);
  for (const double power : kPowers) {
    SCOPED_TRACE(power);
    const double distance = minimum_detectable_kuiper_distance(kLevel, power, kSamples);
    const int rejected = kuiper_rejections(distance);
    expect_power_at_least(power, rejected, kReplicates);
    const double mean = distance * kRootOfSamples;
    expect_power_at_most(normal_cdf(2.0 * (mean - critical) + 1.5 / mean), rejected, kReplicates);
  }
}

TEST(KuiperPower, IsTheInverseOfTheDetectableDistance) {
  for (const double samples : {1e3, 1e6}) {
    for (const double power : {0.1, 0.5, 0.99}) {
      const double distance = minimum_detectable_kuiper_distance(1e-6, power, samples);
      EXPECT_NEAR(kuiper_power(distance, 1e-6, samples), power, 1e-9);
    }
  }
}

// The first of the independent normals that A^2 is made of is d sqrt N + Z / sqrt 2, hence the
// least power. The others add 1/2 to A^2 on average, and with more than 94 % probability less than
// 1 (sums of squares over 6, 12, 20, ...: variance 0.08); then the power is at most that of a
// statistic greater by 1.
TEST(AndersonDarlingPower, OfTheDetectableDistanceIsAsStated) {
  const double critical = critical_value(log10_anderson_darling_tail);
  for (const double power : kPowers) {
    SCOPED_TRACE(power);
    const double distance = minimum_detectable_anderson_darling_distance(kLevel, power, kSamples);
    const int rejected = anderson_darling_rejections(distance);
    expect_power_at_least(power, rejected, kReplicates);
    const double most =
        normal_cdf(std::numbers::sqrt2 * (distance * kRootOfSamples - std::sqrt(critical - 1.0)));
    expect_power_at_most(0.94 * most + 0.06, rejected, kReplicates);
  }
}

TEST(AndersonDarlingPower, IsTheInverseOfTheDetectableDistance) {
  for (const double samples : {1e3, 1e6}) {
    for (const double power : {0.1, 0.5, 0.99}) {
      const double distance = minimum_detectable_anderson_darling_distance(1e-6, power, samples);
      EXPECT_NEAR(anderson_darling_power(distance, 1e-6, samples), power, 1e-9);
    }
  }
}

// The distances are those of the expected counts.
TEST(UniformityDistance, IsThatOfTheDistribution) {
  for (const double d : {0.01, 0.1}) {
    std::vector<std::uint64_t> of_tent;
    std::vector<std::uint64_t> of_parabola;
    constexpr double kMany = 0x1p40;
    for (const double p : cells_of(tent, d)) of_tent.push_back(std::llround(kMany * p));
    for (const double p : cells_of(parabola, d)) of_parabola.push_back(std::llround(kMany * p));
    EXPECT_NEAR(kuiper_test(of_tent).distance, d, 1e-9);
    // The edges leave a share 1/kCells of the integral out, half of it at either end.
    EXPECT_NEAR(anderson_darling_test(of_parabola).distance, d, d / kCells);
  }
}

/// Cells in pairs, of which the first has (1 + w) and the second (1 - w) of its share of a
/// distribution that falls from cell to cell: the effect is w.
struct PairedCells {
  PairedCells(std::size_t cells, double w) {
    double total = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      const std::size_t pair = i / 2;
      expected.push_back(2.0 - static_cast<double>(pair) / static_cast<double>(cells));
      total += expected.back();
    }
    for (double& p : expected) p /= total;
    for (std::size_t i = 0; i < cells; ++i) {
      actual.push_back(expected[i] * (i % 2 == 0 ? 1.0 + w : 1.0 - w));
    }
  }

  std::vector<double> expected;
  std::vector<double> actual;
};

/// What the distribution of counts lacks of a non-central chi-square, of which a rejection is a
/// tail.
constexpr double kChiSquareError = 0.02;

void expect_power(double power, int rejected, int replicates) {
  expect_power_at_least(power - kChiSquareError, rejected, replicates);
  expect_power_at_most(std::min(power + kChiSquareError, 1.0 - 1e-9), rejected, replicates);
}

int fit_rejections(const PairedCells& cells, std::uint64_t samples) {
  const CellDistribution distribution(cells.actual);
  return count_rejections("FitPower", kReplicates, [&](const RandomStream& stream) {
    return cressie_read(distribution.counts(stream, samples), cells.expected, samples).log10_p <
           kLog10Level;
  });
}

// Fewer than 30 degrees of freedom, which are tested on one side, and more.
TEST(FitPower, OfTheDetectableEffectIsAsStated) {
  for (const std::size_t cells : {4U, 64U}) {
    for (const double power : {0.6, 0.9}) {
      SCOPED_TRACE(testing::Message() << cells << " cells, power " << power);
      const double w = minimum_detectable_w(static_cast<double>(cells - 1), kLevel, power, 4096.0);
      const int rejected = fit_rejections(PairedCells(cells, w), 4096);
      expect_power(power, rejected, kReplicates);
    }
  }
}

TEST(FitPower, OfTwoDistributionsIsAsStated) {
  for (const double w : {0.1, 0.12}) {
    const PairedCells cells(64, w);
    const double power = fit_power(cells.expected, cells.actual, kLevel, 4096);
    EXPECT_GT(power, 0.1);
    EXPECT_LT(power, 0.9);
    expect_power(power, fit_rejections(cells, 4096), kReplicates);
  }
}

// Expectations from 14 to 10: the first pairs are a pool each, in which nothing is left to be
// found; then three cells are.
TEST(FitPower, IsThatOfThePools) {
  const PairedCells cells(64, 0.9);
  const std::uint64_t samples = 64 * 12;
  const double power = fit_power(cells.expected, cells.actual, kLevel, samples);
  EXPECT_GT(power, 0.1);
  EXPECT_LT(power, 0.9);
  expect_power(power, fit_rejections(cells, samples), kReplicates);
  EXPECT_EQ(fit_power(cells.expected, cells.actual, kLevel, 20), 0.0) << "one pool";
}

// A sample and another of a quarter of its size, at both of which the test looks.
TEST(TwoSamplesPower, OfTheDetectableEffectIsAsStated) {
  constexpr double kShare = 0.2;  // 1 / (1 + 4)
  constexpr int kSome = 1000;
  for (const double power : {0.6, 0.9}) {
    SCOPED_TRACE(power);
    const double w = minimum_detectable_w(63.0, kLevel, power, 16384.0 * kShare);
    const PairedCells cells(64, w);
    const CellDistribution first(cells.actual);
    const CellDistribution second(cells.expected);
    const int rejected =
        count_rejections("TwoSamplesPower", kSome, [&](const RandomStream& stream) {
          const RandomStream other = stream.substream(kSome + stream.number());
          const GoodnessOfFit fit =
              two_sample_fit(first.counts(stream, 16384), second.counts(other, 4096));
          return fit.log10_p < kLog10Level;
        });
    expect_power(power, rejected, kSome);
  }
}

// The mean of 4096 uniform numbers is normal to a few 1e-5 of the distribution function.
TEST(DetectableZ, IsSeenWithTheStatedPower) {
  for (const double power : kPowers) {
    SCOPED_TRACE(power);
    const double shift =
        minimum_detectable_z(kLevel, power) * std::sqrt(1.0 / 12.0 / static_cast<double>(kSamples));
    const int rejected =
        count_rejections("DetectableZ", kReplicates, [&](const RandomStream& stream) {
          Moments moments;
          for (std::uint64_t i = 0; i < kSamples; ++i) moments.add(stream.point(i).s + shift);
          return mean_test(moments, {0.5, 1.0 / 12.0}).log10_p < kLog10Level;
        });
    expect_power_at_least(power - 1e-4, rejected, kReplicates);
    expect_power_at_most(power + 1e-4, rejected, kReplicates);
  }
}

// A symmetric distribution, so that its p-values are normal here.
TEST(DetectableFactor, IsSeenWithTheStatedPower) {
  const ExactMoments uniform = {0.5, 1.0 / 12.0, 0.5};
  for (const double power : kPowers) {
    SCOPED_TRACE(power);
    const double factor =
        minimum_detectable_factor(kLevel, power, static_cast<double>(kSamples), uniform, 0.5);
    const int rejected =
        count_rejections("DetectableFactor", kReplicates, [&](const RandomStream& stream) {
          Moments moments;
          for (std::uint64_t i = 0; i < kSamples; ++i) moments.add(factor * stream.point(i).s);
          return mean_test(moments, uniform).log10_p < kLog10Level;
        });
    expect_power_at_least(power - 1e-4, rejected, kReplicates);
    expect_power_at_most(power + 1e-4, rejected, kReplicates);
  }
}

int sequential_rejections(double w, int replicates) {
  const PairedCells cells(64, w);
  const CellDistribution distribution(cells.actual);
  const SequentialTest test(cells.expected);
  return count_rejections("SequentialPower", replicates, [&](const RandomStream& stream) {
    const double log10_e = test.log10_e(distribution.counts(stream, 4096));
    return SequentialTest::rejects(log10_e, kLevel);
  });
}

// A bound from below, of which the concentrations that are averaged over take up to their number:
// critical values are then those of 1/alpha times 26, and the power is more than stated. Three
// quarters of the effect, of which the non-centrality is 9/16, are found seldom all the same.
TEST(SequentialPower, OfTheDetectableEffectIsAtLeastAsStated) {
  constexpr int kSome = 500;
  const SequentialTest test(PairedCells(64, 0.0).expected);
  for (const double power : {0.6, 0.9}) {
    SCOPED_TRACE(power);
    const double w = test.minimum_detectable_effect(kLevel, power, 4096.0);
    expect_power_at_least(power, sequential_rejections(w, kSome), kSome);
    expect_power_at_most(power, sequential_rejections(0.75 * w, kSome), kSome);
  }
  EXPECT_TRUE(
      std::isinf(SequentialTest(std::vector<double>{1.0}).minimum_detectable_effect(0.1, 0.5, 10)));
}

}  // namespace
}  // namespace lightproof
