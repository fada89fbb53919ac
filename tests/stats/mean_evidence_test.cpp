// Evidence against a mean, whatever the tails: it is rarely large if the mean is right, and large
// if it is not.
#include "lightproof/stats/mean_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

using Quantile = std::function<double(double)>;

/// Pareto's distribution of this index and a mean of 1: of an infinite variance up to 2.
Quantile pareto(double index) {
  return [index](double u) { return (index - 1.0) / index * std::pow(1.0 - u, -1.0 / index); };
}

/// `value` with the probability 1 / value, else 0.
Quantile rare(double value) {
  return [value](double u) { return u * value < 1.0 ? value : 0.0; };
}

ValueSums drawn(const Quantile& quantile, std::uint64_t count, std::uint64_t seed,
                double factor = 1.0) {
  const RandomStream stream("evidence", seed);
  ValueSums values;
  for (std::uint64_t i = 0; i < count; ++i) values.add(factor * quantile(stream.point(i).s));
  return values;
}

// P(evidence >= 20) <= 1/20 for each of them. More than 150 of 2000 exceed it with a probability of
// 10^-6: P(Binomial(2000, 1/20) > 150) = 8e-7.
TEST(MeanEvidence, IsRarelyLargeIfTheMeanIsRightWhateverTheTails) {
  const double enough = std::log10(20.0);
  const std::vector<std::pair<Quantile, double>> distributions = {
      {pareto(1.2), std::numeric_limits<double>::infinity()},
      {pareto(3.0), std::numeric_limits<double>::infinity()},
      {rare(1e4), 1e4},
      {rare(10.0), 10.0},
      {[](double u) { return 2.0 * u; }, 2.0},
      {[](double) { return 1.0; }, 1.0}};
  for (const auto& [quantile, largest] : distributions) {
    int above = 0;
    int below = 0;
    for (std::uint64_t run = 0; run < 2000; ++run) {
      const ValueSums values = drawn(quantile, 500, run);
      above += log10_evidence_above(values, 1.0) >= enough ? 1 : 0;
      below += log10_evidence_below(values, 1.0, largest) >= enough ? 1 : 0;
    }
    EXPECT_LE(above, 150);
    EXPECT_LE(below, 150);
  }
}

TEST(MeanEvidence, OfAMeanThatIsOffGrowsOnItsOwnSide) {
  const Quantile even = [](double u) { return 2.0 * u; };
  const ValueSums more = drawn(even, 100'000, 1, 1.05);
  EXPECT_GT(log10_evidence_above(more, 1.0), 8.0);
  EXPECT_LT(log10_evidence_below(more, 1.0, 2.1), 0.0);
  const ValueSums less = drawn(even, 100'000, 1, 0.95);
  EXPECT_LT(log10_evidence_above(less, 1.0), 0.0);
  EXPECT_GT(log10_evidence_below(less, 1.0, 2.0), 8.0);
}

// None of 1000 values of 10^4 with a probability of 10^-4 each is no evidence.
TEST(MeanEvidence, OfRareValuesThatDidNotTurnUpIsNone) {
  const ValueSums none = {1000, 0.0, 0.0};
  EXPECT_LT(log10_evidence_below(none, 1.0, 1e4), 0.1);
  EXPECT_GT(log10_evidence_below(none, 1.0, 10.0), 8.0);
}

TEST(MeanEvidence, FindsTheEffectThatItPromises) {
  constexpr std::uint64_t kCount = 20'000;
  constexpr double kEnough = 7.0;
  const double off = detectable_by_evidence(kEnough, kCount, 1.0 / 3.0, 2.0);
  EXPECT_LT(off, 0.05);
  const Quantile even = [](double u) { return 2.0 * u; };
  // Of 300 runs each is found with 99 %: fewer than 284 are with a probability of 10^-7.
  int found = 0;
  for (std::uint64_t run = 0; run < 300; ++run) {
    found += log10_evidence_below(drawn(even, kCount, run, 1.0 - off), 1.0, 2.0) >= kEnough ? 1 : 0;
  }
  EXPECT_GE(found, 284);
  EXPECT_EQ(detectable_by_evidence(kEnough, 0, 1.0, 2.0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace lightproof
