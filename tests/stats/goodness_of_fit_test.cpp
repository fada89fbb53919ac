#include "lightproof/stats/goodness_of_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "all_counts.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using testing::ElementsAre;
using Counts = std::vector<std::uint64_t>;

/// Cressie-Read's statistic as printed: 9/5 sum O ((O/E)^(2/3) - 1), for sums O and E that agree.
double printed_statistic(const std::vector<double>& observed, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    sum += observed[i] * (std::pow(observed[i] / expected[i], 2.0 / 3.0) - 1.0);
  }
  return 9.0 / 5.0 * sum;
}

/// Half a unit in the last place of terms up to N, a few times.
constexpr double kRounding = 1e-12;

TEST(CressieRead, OfAHandComputedTable) {
  const auto fit = cressie_read(Counts{80, 90, 30}, std::array{0.3, 0.5, 0.2}, 200);
  EXPECT_NEAR(fit.statistic, 10.031094561320407, kRounding);
  EXPECT_EQ(fit.dof, 2.0);
  // Two degrees of freedom: the tail is exp(-x/2).
  EXPECT_NEAR(fit.log10_p, -0.5 * 10.031094561320407 / std::numbers::ln10, kRounding);
  EXPECT_NEAR(fit.effect, std::sqrt((10.031094561320407 - 2.0) / 200.0), kRounding);
  EXPECT_EQ(fit.possible_cells, 3U);
  EXPECT_EQ(fit.impossible_hits, 0U);
  EXPECT_FALSE(fit.first_impossible);
}

TEST(CressieRead, OfAPerfectFitIsZero) {
  const auto fit = cressie_read(Counts{60, 100, 40}, std::array{0.3, 0.5, 0.2}, 200);
  EXPECT_NEAR(fit.statistic, 0.0, kRounding);
  EXPECT_NEAR(fit.log10_p, 0.0, kRounding);
  EXPECT_EQ(fit.effect, 0.0);
}

TEST(CressieRead, OfAnEmptyCellIsFinite) {
  const auto fit = cressie_read(Counts{0, 200}, std::array{0.25, 0.75}, 200);
  EXPECT_NEAR(fit.statistic, printed_statistic({1e-300, 200}, {50, 150}), kRounding);
  EXPECT_LT(fit.log10_p, -6.0);
}

TEST(CressieRead, PoolsNeighboursToTwentyFiveAndTheRestWithTheLast) {
  // Ten expected in each of 8 cells: pools of 3, 3, and the last takes the 2 that are left.
  const std::vector<double> probability(8, 0.125);
  const auto fit = cressie_read(Counts{10, 5, 12, 3, 13, 9, 18, 10}, probability, 80);
  EXPECT_EQ(fit.dof, 1.0);
  EXPECT_NEAR(fit.statistic, printed_statistic({27, 53}, {30, 50}), kRounding);
  EXPECT_EQ(fit.possible_cells, 8U);
}

TEST(CressieRead, KeepsACellOfTwentyFiveToItself) {
  const std::vector<double> probability(4, 0.25);
  EXPECT_EQ(cressie_read(Counts{25, 25, 25, 25}, probability, 100).dof, 3.0);
  EXPECT_EQ(cressie_read(Counts{24, 24, 24, 24}, probability, 96).dof, 1.0);
}

TEST(CressieRead, HasNoVerdictOnASinglePool) {
  for (const auto& probability : {std::vector{1.0}, std::vector{0.5, 0.5}}) {
    Counts counts(probability.size());
    counts[0] = 30;
    const auto fit = cressie_read(counts, probability, 30);
    EXPECT_EQ(fit.dof, 0.0);
    EXPECT_EQ(fit.log10_p, 0.0);
  }
  const auto few = cressie_read(Counts{2, 1}, std::array{0.5, 0.5}, 3);
  EXPECT_EQ(few.dof, 0.0) << "fewer samples than one pool needs";
}

TEST(CressieRead, RejectsAHitInAnImpossibleCellAndNamesIt) {
  const auto fit =
      cressie_read(Counts{500, 0, 498, 1, 1}, std::array{0.5, 0.0, 0.5, 0.0, 0.0}, 1000);
  EXPECT_EQ(fit.log10_p, -INFINITY);
  EXPECT_EQ(fit.impossible_hits, 2U);
  ASSERT_TRUE(fit.first_impossible);
  EXPECT_EQ(*fit.first_impossible, 3U);
  EXPECT_EQ(fit.possible_cells, 2U);
}

TEST(CressieRead, RejectsAnImpossibleHitEvenWithoutDegreesOfFreedom) {
  const auto fit = cressie_read(Counts{999, 1}, std::array{1.0, 0.0}, 1000);
  EXPECT_EQ(fit.dof, 0.0);
  EXPECT_EQ(fit.log10_p, -INFINITY);
  EXPECT_EQ(fit.first_impossible, 1U);
}

TEST(CressieRead, IgnoresImpossibleCellsThatAreNotHit) {
  const auto without = cressie_read(Counts{80, 90, 30}, std::array{0.3, 0.5, 0.2}, 200);
  const auto with =
      cressie_read(Counts{0, 80, 0, 90, 30, 0}, std::array{0.0, 0.3, 0.0, 0.5, 0.2, 0.0}, 200);
  EXPECT_EQ(with.statistic, without.statistic);
  EXPECT_EQ(with.log10_p, without.log10_p);
}

/// 1000 cells, the last 49 of which expect 0.1 each, 4.9 in all.
struct ThinTail {
  static constexpr std::uint64_t kSamples = 100000;
  std::vector<double> probability = std::vector<double>(1000, 0.1 / kSamples);
  Counts counts = Counts(1000, 0);

  /// Counts as expected, but with `leak` of the samples spread over the thin cells.
  explicit ThinTail(double leak) {
    const double thick = (1.0 - 49.0 * 0.1 / kSamples) / 951.0;
    std::fill_n(probability.begin(), 951, thick);
    const auto leaked = static_cast<std::uint64_t>(leak * kSamples);
    const std::uint64_t rest = kSamples - leaked;
    for (std::size_t i = 0; i < 951; ++i) counts[i] = rest * (i + 1) / 951 - rest * i / 951;
    for (std::size_t i = 0; i < 49; ++i) counts[951 + i] = leaked * (i + 1) / 49 - leaked * i / 49;
  }
};

TEST(CressieRead, SeesALeakIntoCellsThatPoolingMightDrop) {
  const ThinTail correct(0.00005);
  ASSERT_EQ(std::accumulate(correct.counts.begin(), correct.counts.end(), std::uint64_t{0}),
            ThinTail::kSamples);
  const auto fit = cressie_read(correct.counts, correct.probability, ThinTail::kSamples);
  EXPECT_GT(log10_chi_square_tail(fit.statistic, fit.dof), -6.0);
  EXPECT_TRUE(fit.underdispersed) << "these counts are no random ones";
  EXPECT_LT(fit.log10_p, -6.0);
  const ThinTail leaking(0.01);
  EXPECT_LT(cressie_read(leaking.counts, leaking.probability, ThinTail::kSamples).log10_p, -6.0);
}

TEST(CressieRead, SeesALeakWhereverTheThinCellsLie) {
  // Rotated by every amount, the thin cells stand first, in the middle and last.
  ThinTail leaking(0.01);
  for (int i = 0; i < 1000; ++i) {
    std::rotate(leaking.counts.begin(), leaking.counts.begin() + 1, leaking.counts.end());
    std::rotate(leaking.probability.begin(), leaking.probability.begin() + 1,
                leaking.probability.end());
    EXPECT_LT(cressie_read(leaking.counts, leaking.probability, ThinTail::kSamples).log10_p, -6.0)
        << i;
  }
}

TEST(CressieRead, ResolvesTailsBeyondDoubles) {
  const auto fit = cressie_read(Counts{900000, 100000}, std::array{0.5, 0.5}, 1000000);
  EXPECT_LT(fit.log10_p, -1000.0);
  EXPECT_GT(fit.log10_p, -INFINITY);
}

TEST(CressieRead, EffectIsCohensW) {
  // w^2 = sum (q-p)^2/p = 2 * 0.01^2/0.5. N w^2 = 400, of which the one degree of freedom is
  // taken off; the cubic terms of the statistic cancel between the cells.
  const auto fit = cressie_read(Counts{510000, 490000}, std::array{0.5, 0.5}, 1000000);
  EXPECT_NEAR(fit.effect, std::sqrt(399.0 / 1e6), 1e-6);
}

/// P(Poisson <= count) below the mean and P(Poisson >= count) from it on, term by term.
long double poisson_tail(std::uint64_t count, long double mean) {
  long double term = std::exp(-mean);
  long double lower = 0.0L;
  std::uint64_t k = 0;
  for (; k < count; ++k) {
    lower += term;
    term *= mean / static_cast<long double>(k + 1);
  }
  if (static_cast<long double>(count) < mean) return lower + term;
  long double upper = 0.0L;
  for (; term > 1e-22L * upper; ++k) {
    upper += term;
    term *= mean / static_cast<long double>(k + 1);
  }
  return upper;
}

TEST(WorstCell, HasTheTailOfItsCellTimesTwiceTheirNumber) {
  const std::vector<double> probability = {0.5, 0.25, 0.125, 0.0625, 0.0625};
  for (const Counts& counts :
       {Counts{8, 4, 2, 1, 9}, Counts{1, 12, 4, 4, 3}, Counts{12, 0, 6, 3, 3},
        Counts{24, 0, 0, 0, 0}, Counts{0, 0, 0, 0, 24}, Counts{6, 6, 12, 0, 0}}) {
    const WorstCell worst = worst_cell(counts, probability, 24);
    EXPECT_EQ(worst.observed, static_cast<double>(counts[worst.cell]));
    EXPECT_EQ(worst.expected, 24.0 * probability[worst.cell]);
    const long double own = poisson_tail(counts[worst.cell], worst.expected);
    EXPECT_NEAR(worst.log10_p, static_cast<double>(std::min(0.0L, std::log10(own * 2.0L * 5.0L))),
                kRounding);
    // Chernoff's exponent D of another cell is no larger, and by Stirling's formula a tail is at
    // least its first term, exp(-D - 1 / (12 n)) / sqrt(2 pi n) for a count of n.
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto n = std::max(1.0L, static_cast<long double>(counts[i]));
      const long double least = own * std::exp(-1.0L / (12.0L * n)) /
                                std::sqrt(2.0L * std::numbers::pi_v<long double> * n);
      EXPECT_GE(poisson_tail(counts[i], 24.0L * static_cast<long double>(probability[i])), least);
    }
  }
}

TEST(WorstCell, IsTheOneThatIsOff) {
  const std::vector<double> probability = {0.5, 0.25, 0.125, 0.0625, 0.0625};
  EXPECT_EQ(worst_cell(Counts{8, 4, 2, 1, 9}, probability, 24).cell, 4U);
  EXPECT_EQ(worst_cell(Counts{1, 12, 4, 4, 3}, probability, 24).cell, 0U);
  EXPECT_EQ(worst_cell(Counts{6, 6, 12, 0, 0}, probability, 24).cell, 2U);
}

TEST(WorstCell, HasAPValueOfTheRightSizeForEveryOutcome) {
  // P(p <= t) <= t under the multinomial distribution itself, of which the Poisson distribution is
  // a bound only, at every t that occurs: summed over all outcomes.
  for (const std::vector<double>& probability :
       {std::vector{0.5, 0.5}, std::vector{0.9, 0.1}, std::vector{0.2, 0.3, 0.5},
        std::vector{0.98, 0.01, 0.01}, std::vector{0.1, 0.2, 0.3, 0.4}}) {
    constexpr std::uint64_t kSamples = 16;
    std::vector<std::pair<double, double>> outcomes;  // log10 p, its probability
    Counts counts(probability.size());
    for_all_counts(counts, 0, kSamples, [&](const Counts& outcome) {
      double chance = std::tgamma(kSamples + 1.0);
      for (std::size_t i = 0; i < outcome.size(); ++i) {
        const auto n = static_cast<double>(outcome[i]);
        chance *= std::pow(probability[i], n) / std::tgamma(n + 1.0);
      }
      outcomes.emplace_back(worst_cell(outcome, probability, kSamples).log10_p, chance);
    });
    std::sort(outcomes.begin(), outcomes.end());
    double sum = 0.0;
    for (const auto& [log10_p, chance] : outcomes) {
      sum += chance;
      EXPECT_LE(sum, std::pow(10.0, log10_p) * (1.0 + kRounding));
    }
  }
}

TEST(WorstCell, CountsAllPossibleCellsAndNoOthers) {
  // Nothing where 100 are expected: exp(-100), among 10 cells and among 1000.
  for (const std::size_t cells : {10U, 1000U}) {
    const std::vector<double> probability(cells, 1.0 / static_cast<double>(cells));
    Counts counts(cells, 100);
    counts[7] = 0;
    const WorstCell worst = worst_cell(counts, probability, 100 * cells);
    EXPECT_EQ(worst.cell, 7U);
    const double exact = -100.0 / std::numbers::ln10 + std::log10(2.0 * static_cast<double>(cells));
    EXPECT_NEAR(worst.log10_p, exact, kRounding);
  }
}

// The effect that is seen is a bound for all cells: that of the likeliest.
TEST(WorstCell, KnowsTheLikeliest) {
  const WorstCell worst = worst_cell(Counts{5, 0, 20}, std::array{0.25, 0.0, 0.75}, 25);
  EXPECT_EQ(worst.likeliest, 0.75);
  EXPECT_EQ(worst.cells, 2U);
}

TEST(WorstCell, LeavesImpossibleCellsOut) {
  const auto without = worst_cell(Counts{80, 90, 30}, std::array{0.3, 0.5, 0.2}, 200);
  const auto with = worst_cell(Counts{7, 80, 0, 90, 30}, std::array{0.0, 0.3, 0.0, 0.5, 0.2}, 200);
  EXPECT_EQ(without.cell, 0U);
  EXPECT_EQ(with.cell, 1U);
  EXPECT_EQ(with.log10_p, without.log10_p);
}

TEST(WorstCell, SaysNothingOfCountsAsExpected) {
  const auto worst = worst_cell(Counts{60, 100, 40}, std::array{0.3, 0.5, 0.2}, 200);
  EXPECT_EQ(worst.log10_p, 0.0);
  EXPECT_EQ(worst_cell(Counts{}, std::vector<double>{}, 0).log10_p, 0.0);
}

TEST(WorstCell, FindsAnOutlierInAFaintCellThatMovesNoSum) {
  // Ten samples where a thousandth of one is expected, among 4096 cells that fit: far from chance,
  // and pooled with a neighbour of 1000 it is nothing.
  constexpr std::size_t kCells = 4096;
  constexpr std::uint64_t kSamples = 1000 * kCells;
  constexpr double kFaint = 0.001 / static_cast<double>(kSamples);
  std::vector<double> probability(kCells, (1.0 - kFaint) / (kCells - 1.0));
  probability[1234] = kFaint;
  // Every other cell one standard deviation off, alternately, as chance would have it.
  Counts counts(kCells);
  for (std::size_t i = 0; i < kCells; ++i) counts[i] = i % 2 == 0 ? 968 : 1032;
  counts[1234] = 10;
  const WorstCell worst = worst_cell(counts, probability, kSamples);
  EXPECT_EQ(worst.cell, 1234U);
  EXPECT_EQ(worst.observed, 10.0);
  EXPECT_NEAR(worst.expected, 0.001, kRounding);
  // The first term, m^10 exp(-m) / 10!, and the next, m / 11 of it; the rest is below m^2.
  const double first = 10.0 * std::log10(0.001) - std::log10(3628800.0);
  const double next = (0.001 / 11.0 - 0.001) / std::numbers::ln10;
  EXPECT_NEAR(worst.log10_p, first + next + std::log10(2.0 * kCells), 1e-6);
  EXPECT_GT(cressie_read(counts, probability, kSamples).log10_p, -3.0);
}

/// P(Poisson >= count), by its terms from there on.
double poisson_upper(int count, double mean) {
  double term = std::exp(count * std::log(mean) - mean - std::lgamma(count + 1.0));
  double sum = 0.0;
  for (int k = count; term > 1e-20 * sum || k < mean; ++k) {
    sum += term;
    term *= mean / (k + 1);
  }
  return sum;
}

TEST(WorstCell, CriticalCountIsTheFirstWhoseTailIsBelowTheLevel) {
  for (const double mean : {1e-6, 0.01, 1.0, 32.0, 1000.0}) {
    for (const double level : {1e-3, 1e-9}) {
      const auto count = static_cast<int>(critical_count(mean, level));
      EXPECT_LE(poisson_upper(count, mean), level) << mean;
      EXPECT_GT(poisson_upper(count - 1, mean), level) << mean;
    }
  }
}

// The normal distribution promised 99.5 % of an excess that a Poisson count shows in 28 % of runs
// where a texel expects two samples.
TEST(WorstCell, TheExcessThatItPromisesIsFoundThatOften) {
  constexpr double kLevel = 1e-3;
  constexpr double kPower = 0.995;
  for (const double mean : {2.0, 32.0, 320.0, 32000.0}) {
    const WorstCell worst = {.cells = 1U << 17U, .likeliest = mean / 0x1p22};
    const double excess = minimum_detectable_excess(worst, kLevel, kPower, 0x1p22);
    const auto critical = static_cast<int>(critical_count(mean, 0.5 * kLevel / 0x1p17));
    EXPECT_NEAR(poisson_upper(critical, mean * (1.0 + excess)), kPower, 1e-9) << mean;
  }
}

TEST(WorstCell, PromisesNothingThatNeedsMoreThanAllSamples) {
  const WorstCell all = {.cells = 1, .likeliest = 1.0};
  EXPECT_TRUE(std::isinf(minimum_detectable_excess(all, 1e-3, 0.99, 1024.0)));
  const WorstCell half = {.cells = 2, .likeliest = 0.5};
  EXPECT_TRUE(std::isinf(minimum_detectable_excess(half, 1e-3, 0.99, 16.0)));
  EXPECT_LT(minimum_detectable_excess(half, 1e-3, 0.99, 1024.0), 1.0);
}

// Counts equal to expectations that are not whole numbers of a double: the sum of what is 0 was
// -1e-13, and no distribution knows that.
TEST(CressieRead, IsNeverBelowZero) {
  for (std::uint64_t n = 1000; n < 1200; ++n) {
    for (int cells = 2; cells < 30; ++cells) {
      Counts counts;
      std::vector<double> probability;
      const std::uint64_t all = n * static_cast<std::uint64_t>(cells * (cells + 1) / 2);
      for (int i = 1; i <= cells; ++i) {
        counts.push_back(n * static_cast<std::uint64_t>(i));
        probability.push_back(static_cast<double>(counts.back()) / static_cast<double>(all));
      }
      const GoodnessOfFit fit = cressie_read(counts, probability, all);
      ASSERT_GE(fit.statistic, 0.0);
      ASSERT_LE(fit.log10_p, 0.0);
    }
  }
}

// Pearson's statistic of the table {40, 60}, {60, 40} is four times 10^2 / 50; Cressie and Read's
// divergence is within a few percent of it.
TEST(TwoSamples, OfTwoCellsAreNearPearson) {
  const std::vector<std::uint64_t> first = {40, 60};
  const std::vector<std::uint64_t> second = {60, 40};
  const GoodnessOfFit fit = two_sample_fit(first, second);
  EXPECT_EQ(fit.dof, 1.0);
  EXPECT_NEAR(fit.statistic, 8.0, 0.2);
  EXPECT_NEAR(fit.statistic, two_sample_fit(second, first).statistic, 1e-12);
  // The excess over the degree of freedom, times (n1 + n2) / (n1 n2).
  EXPECT_NEAR(fit.effect, std::sqrt(0.02 * (fit.statistic - 1.0)), 1e-12);
}

TEST(TwoSamples, InTheSameProportionsAgreeWhateverTheirSizes) {
  const std::vector<std::uint64_t> few = {30, 60, 90};
  const std::vector<std::uint64_t> many = {300, 600, 900};
  EXPECT_NEAR(two_sample_fit(few, many).statistic, 0.0, 1e-9);
  EXPECT_EQ(two_sample_fit(few, many).dof, 2.0);
  EXPECT_EQ(two_sample_fit(few, many).effect, 0.0);
}

TEST(TwoSamples, PoolThinCellsAndLeaveEmptyOnesOut) {
  const std::vector<std::uint64_t> first = {0, 20, 20, 0, 200, 3};
  const std::vector<std::uint64_t> second = {0, 20, 20, 0, 200, 3};
  const GoodnessOfFit fit = two_sample_fit(first, second);
  EXPECT_EQ(fit.dof, 1.0);
  EXPECT_EQ(fit.possible_cells, 4U);
}

TEST(Serpentine, TurnsEverySecondRow) {
  Grid<int> grid({3, 3});
  std::iota(grid.values().begin(), grid.values().end(), 0);
  EXPECT_THAT(serpentine(grid), ElementsAre(0, 1, 2, 5, 4, 3, 6, 7, 8));
}

TEST(TwoSampleFit, OfNoSampleOnOneSideIsOpenAndIsANumber) {
  const std::vector<std::uint64_t> some = {10, 20, 30};
  const std::vector<std::uint64_t> none = {0, 0, 0};
  const GoodnessOfFit fit = two_sample_fit(some, none);
  EXPECT_EQ(fit.dof, 0.0);
  EXPECT_EQ(fit.effect, 0.0);
  EXPECT_GT(fit.possible_cells, 1U) << "it would count as accepted";
}

TEST(CressieRead, OfAGridIsThatOfItsSerpentine) {
  const RandomStream stream("CressieRead.OfAGrid", 1);
  for (const Extent extent : {Extent{1, 1}, Extent{7, 1}, Extent{1, 6}, Extent{16, 9}}) {
    for (const std::uint64_t samples : {1U, 30U, 1000U, 100000U}) {
      Grid<double> probability(extent);
      Grid<std::uint64_t> counts(extent);
      double sum = 0.0;
      for (std::size_t i = 0; i < extent.count(); ++i) {
        const double share = i % 5 == 3 ? 0.0 : 0.1 + stream.point(i).s;
        probability.values()[i] = share;
        sum += share;
      }
      std::uint64_t counted = 0;
      for (std::size_t i = 0; i < extent.count(); ++i) {
        probability.values()[i] /= sum;
        counts.values()[i] = std::min(samples - counted, samples * (i % 3) / extent.count());
        counted += counts.values()[i];
      }
      const GoodnessOfFit along =
          cressie_read(serpentine(counts), serpentine(probability), samples);
      const GoodnessOfFit of_grid = cressie_read(counts, probability, samples);
      EXPECT_EQ(of_grid.statistic, along.statistic);
      EXPECT_EQ(of_grid.dof, along.dof);
      EXPECT_EQ(of_grid.log10_p, along.log10_p);
      EXPECT_EQ(of_grid.effect, along.effect);
      EXPECT_EQ(of_grid.possible_cells, along.possible_cells);
      EXPECT_EQ(of_grid.impossible_hits, along.impossible_hits);
      EXPECT_EQ(of_grid.first_impossible, along.first_impossible);
    }
  }
}

}  // namespace
}  // namespace lightproof
