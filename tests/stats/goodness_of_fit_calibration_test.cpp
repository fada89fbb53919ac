#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/tails.h"
#include "uniformity.h"

namespace lightproof {
namespace {

/// Half of the mass is uniform over all cells, the other half over the first half of them: the
/// cells' probabilities are 3 : 1. With a positive `defect` every odd cell gives this share of
/// its mass to the even one before it.
class TwoSteps {
 public:
  TwoSteps(std::size_t cells, double defect) : cells_(cells), defect_(defect) {}

  std::vector<double> probability() const {
    const auto n = static_cast<double>(cells_);
    std::vector<double> p(cells_, 0.5 / n);
    for (std::size_t i = 0; i < cells_ / 2; ++i) p[i] = 1.5 / n;
    return p;
  }

  /// Counts of `samples` draws of replicate number `replicate`.
  std::vector<std::uint64_t> counts(const RandomStream& all, std::uint64_t replicate,
                                    std::uint64_t samples) const {
    const RandomStream stream = all.substream(replicate);
    std::vector<std::uint64_t> counts(cells_);
    for (std::uint64_t i = 0; i < samples; ++i) ++counts[cell(stream.point(i))];
    return counts;
  }

 private:
  std::size_t cell(SquarePoint u) const {
    const std::size_t range = u.t < 0.5 ? cells_ / 2 : cells_;
    const double scaled = u.s * static_cast<double>(range);
    const auto index = static_cast<std::size_t>(scaled);
    const bool moves = index % 2 == 1 && scaled - std::floor(scaled) < defect_;
    return moves ? index - 1 : index;
  }

  std::size_t cells_;
  double defect_;
};

std::vector<double> p_values(const char* name, std::size_t cells, std::uint64_t samples) {
  const TwoSteps distribution(cells, 0.0);
  const RandomStream stream(name, 1);
  std::vector<double> log10_p;
  for (std::uint64_t replicate = 0; replicate < 2000; ++replicate) {
    const auto counts = distribution.counts(stream, replicate, samples);
    log10_p.push_back(cressie_read(counts, distribution.probability(), samples).log10_p);
  }
  return log10_p;
}

// The chi-square distribution holds for large expectations: 64 and more in every cell here.
TEST(CressieReadCalibration, PValuesOf256CellsAreUniform) {
  expect_uniform(p_values("CressieReadCalibration.PValuesOf256CellsAreUniform", 256, 32768));
}

// With few cells one degree of freedom too many shifts the p-values by 0.1 and more.
TEST(CressieReadCalibration, PValuesOfFourCellsAreUniform) {
  expect_uniform(p_values("CressieReadCalibration.PValuesOfFourCellsAreUniform", 4, 4096));
}

// Cells of expectation 0.3 and 1 that follow the distribution only because they are pooled, into 6
// pools.
TEST(CressieReadCalibration, PValuesOfPooledCellsAreUniform) {
  expect_uniform(p_values("CressieReadCalibration.PValuesOfPooledCellsAreUniform", 256, 170));
}

// 64 cells, expected 32 times and more in the smaller sample.
TEST(TwoSamplesCalibration, PValuesAreUniform) {
  const TwoSteps distribution(64, 0.0);
  const RandomStream first("TwoSamplesCalibration.first", 1);
  const RandomStream second("TwoSamplesCalibration.second", 1);
  std::vector<double> log10_p;
  for (std::uint64_t replicate = 0; replicate < 2000; ++replicate) {
    log10_p.push_back(two_sample_fit(distribution.counts(first, replicate, 16384),
                                     distribution.counts(second, replicate, 4096))
                          .log10_p);
  }
  expect_uniform(log10_p);
}

// At the planned effect two samples of N and N/4 reject like one of N/5.
TEST(TwoSamplesPower, IsThatOfTheHarmonicSize) {
  constexpr double kAlpha = 1e-3;
  constexpr std::uint64_t kFirst = 16384;
  const double w = minimum_detectable_w(63.0, kAlpha, 0.5, kFirst / 5.0);
  const TwoSteps distribution(64, 0.0);
  const TwoSteps defect(64, w);
  const RandomStream first("TwoSamplesPower.first", 1);
  const RandomStream second("TwoSamplesPower.second", 1);
  int rejected = 0;
  for (std::uint64_t replicate = 0; replicate < 1000; ++replicate) {
    const GoodnessOfFit fit = two_sample_fit(defect.counts(first, replicate, kFirst),
                                             distribution.counts(second, replicate, kFirst / 4));
    rejected += fit.log10_p < std::log10(kAlpha) ? 1 : 0;
  }
  // Half of 1000 within five standard deviations of 16 (one in a million), and 2 % for the
  // approximation by a non-central chi-square.
  EXPECT_NEAR(rejected, 500, 5 * 16 + 20);
}

/// The share of the mass that must move for an effect w, and its test at the planned N.
class InjectedDefect {
 public:
  explicit InjectedDefect(double power)
      : noncentrality_(minimum_detectable_noncentrality(kCells - 1.0, kAlpha, power)) {}

  /// (q-p)/p is +-d in all cells, so w = d.
  double w() const { return std::sqrt(noncentrality_ / static_cast<double>(kSamples)); }

  int rejections(const char* name, int replicates) {
    const TwoSteps distribution(kCells, w());
    const RandomStream stream(name, 1);
    int rejected = 0;
    for (int i = 0; i < replicates; ++i) {
      const auto counts = distribution.counts(stream, static_cast<std::uint64_t>(i), kSamples);
      const auto fit = cressie_read(counts, distribution.probability(), kSamples);
      if (fit.log10_p < std::log10(kAlpha)) ++rejected;
      mean_square_effect_ += fit.effect * fit.effect / replicates;
    }
    return rejected;
  }
  double mean_square_effect() const { return mean_square_effect_; }

 private:
  static constexpr std::size_t kCells = 256;
  static constexpr std::uint64_t kSamples = 65536;
  static constexpr double kAlpha = 1e-6;
  double noncentrality_;
  double mean_square_effect_ = 0.0;
};

TEST(CressieReadPower, DetectsThePlannedEffect) {
  InjectedDefect injected(0.99);
  const int rejected = injected.rejections("CressieReadPower.DetectsThePlannedEffect", 300);
  // Misses are Poisson with mean 3: more than 16 with a probability of 1e-8.
  EXPECT_GE(rejected, 300 - 16);
  // The effect squared times N is the noncentrality with a standard deviation of
  // sqrt(2 (255 + 2 * 204)) = 36 of 204, or 1 % of it in the mean over 300: five of them.
  EXPECT_NEAR(injected.mean_square_effect() / (injected.w() * injected.w()), 1.0, 0.05);
}

TEST(CressieReadPower, IsHalfWherePlannedToBeHalf) {
  InjectedDefect injected(0.5);
  const int rejected = injected.rejections("CressieReadPower.IsHalfWherePlannedToBeHalf", 300);
  // Binomial around 150 with a standard deviation of 8.7: 4.9 of them are exceeded at 1e-6.
  EXPECT_NEAR(rejected, 150, 42);
}

}  // namespace
}  // namespace lightproof
