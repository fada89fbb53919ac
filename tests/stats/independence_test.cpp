#include "lightproof/stats/independence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// Counts of pairs (x_i, x_i+1), which overlap, over 8 x 8 cells.
Grid<std::uint64_t> overlapping_pairs(const RandomStream& stream, std::uint64_t count,
                                      double mix_in) {
  Grid<std::uint64_t> counts({8, 8});
  int last = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const SquarePoint u = stream.point(i);
    const int next = u.t < mix_in ? last : static_cast<int>(8.0 * u.s);
    if (i > 0) ++counts(next, last);
    last = next;
  }
  return counts;
}

TEST(Independence, OfATwoByTwoTableIsNearPearson) {
  // Pearson's statistic of {60, 40}, {40, 60} is 4 x 10^2 / 50 = 8 with one degree of freedom.
  Grid<std::uint64_t> counts({2, 2});
  counts(0, 0) = counts(1, 1) = 60;
  counts(1, 0) = counts(0, 1) = 40;
  const GoodnessOfFit fit = independence_fit(counts);
  EXPECT_EQ(fit.dof, 1.0);
  EXPECT_NEAR(fit.statistic, 8.0, 0.2);
}

TEST(Independence, OfAProductOfMarginsIsExactWhateverTheMargins) {
  Grid<std::uint64_t> counts({4, 4});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) counts(x, y) = static_cast<std::uint64_t>(100 * (x + 1) * (y + 1));
  }
  const GoodnessOfFit fit = independence_fit(counts);
  EXPECT_EQ(fit.dof, 9.0);
  EXPECT_NEAR(fit.statistic, 0.0, 1e-9);
}

TEST(Independence, MergesCellsUntilThereAreTwentyFiveOfEach) {
  Grid<std::uint64_t> counts({8, 8}, 24);  // 1536 counts
  EXPECT_EQ(independence_fit(counts).dof, 9.0);
  counts(0, 0) += 64;
  EXPECT_EQ(independence_fit(counts).dof, 49.0);
  EXPECT_EQ(independence_fit(Grid<std::uint64_t>({8, 8}, 1)).dof, 0.0);
}

TEST(Independence, HasTheSquareOfTheCellsLessOneAsDegreesOfFreedom) {
  EXPECT_EQ(independence_dof(25 * 64, 8), 49.0);
  EXPECT_EQ(independence_dof(25 * 64 - 1, 8), 9.0);
  EXPECT_EQ(independence_dof(25 * 4, 8), 1.0);
  EXPECT_EQ(independence_dof(25 * 4 - 1, 8), 0.0);
}

// A number is in two pairs, but a test of the interaction alone does not mind. Kolmogorov's test of
// 2000 p-values at 1e-6: of the degrees of freedom of the margins, 14, it would see one.
TEST(Independence, PValuesOfOverlappingPairsAreUniform) {
  constexpr std::size_t kReplicates = 2000;
  std::vector<double> p;
  for (std::uint64_t i = 0; i < kReplicates; ++i) {
    const RandomStream stream("Independence.PValuesOfOverlappingPairsAreUniform", i);
    const GoodnessOfFit fit = independence_fit(overlapping_pairs(stream, 8192, 0.0));
    EXPECT_EQ(fit.dof, 49.0);
    p.push_back(std::pow(10.0, fit.log10_p));
  }
  std::sort(p.begin(), p.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    distance = std::max({distance, static_cast<double>(i + 1) / kReplicates - p[i],
                         p[i] - static_cast<double>(i) / kReplicates});
  }
  EXPECT_GT(log10_kolmogorov_tail(distance * std::sqrt(double{kReplicates})), -6.0);
}

// A share e of numbers that repeat the one before makes an effect of e sqrt(7) on 8 x 8 cells.
TEST(Independence, FindsTheEffectThatItPromises) {
  constexpr std::uint64_t kCount = 1U << 14U;
  constexpr double kLevel = 1e-3;
  constexpr double kPower = 0.9;
  const double effect = minimum_detectable_w(49.0, kLevel, kPower, kCount);
  int found = 0;
  constexpr int kReplicates = 1000;
  for (int i = 0; i < kReplicates; ++i) {
    const RandomStream stream("Independence.FindsTheEffectThatItPromises",
                              static_cast<std::uint64_t>(i));
    const auto fit = independence_fit(overlapping_pairs(stream, kCount, effect / std::sqrt(7.0)));
    found += fit.log10_p < std::log10(kLevel) ? 1 : 0;
  }
  // The binomial standard deviation is 0.0095, of which 4.9 are exceeded at 1e-6.
  EXPECT_NEAR(static_cast<double>(found) / kReplicates, kPower, 4.9 * 0.0095);
}

TEST(Independence, SumsOfFitsAddDegreesOfFreedom) {
  std::array<GoodnessOfFit, 2> fits;
  fits[0].statistic = 10.0;
  fits[0].dof = 9.0;
  fits[1].statistic = 30.0;
  fits[1].dof = 25.0;
  const GoodnessOfFit sum = sum_of_fits(fits, 100);
  EXPECT_EQ(sum.statistic, 40.0);
  EXPECT_EQ(sum.dof, 34.0);
  EXPECT_NEAR(sum.effect, std::sqrt(6.0 / 100.0), 1e-15);
}

TEST(IrwinHall, OfOneTwoAndThreeTerms) {
  EXPECT_NEAR(irwin_hall_cdf(1, 0.3), 0.3, 1e-15);
  EXPECT_NEAR(irwin_hall_cdf(2, 0.5), 0.125, 1e-15);
  EXPECT_NEAR(irwin_hall_cdf(2, 1.5), 1.0 - 0.125, 1e-15);
  // The cube's corner is 1/6; the middle slice up to 2 holds 5/6.
  EXPECT_NEAR(irwin_hall_cdf(3, 1.0), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(irwin_hall_cdf(3, 2.0), 5.0 / 6.0, 1e-15);
  EXPECT_EQ(irwin_hall_cdf(3, 0.0), 0.0);
  EXPECT_EQ(irwin_hall_cdf(3, 3.0), 1.0);
}

TEST(IrwinHall, OfSixteenTermsIsTheFoldedIntegralOfFifteen) {
  // F_n(x) is the mean of F_(n-1) over [x-1, x]: by Simpson's rule in steps of 1/1000.
  for (const double x : {3.3, 7.1, 8.0, 9.7}) {
    constexpr int kSteps = 1000;
    double sum = irwin_hall_cdf(15, x - 1.0) + irwin_hall_cdf(15, x);
    for (int i = 1; i < kSteps; ++i) {
      sum += (i % 2 == 0 ? 2.0 : 4.0) * irwin_hall_cdf(15, x - 1.0 + double{1.0} * i / kSteps);
    }
    EXPECT_NEAR(irwin_hall_cdf(16, x), sum / (3.0 * kSteps), 1e-11) << x;
  }
}

TEST(IrwinHall, QuantilesDivideTheSumsEvenly) {
  const std::vector<double> quantiles = irwin_hall_quantiles(16, 32);
  ASSERT_EQ(quantiles.size(), 31U);
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    EXPECT_NEAR(irwin_hall_cdf(16, quantiles[i]), static_cast<double>(i + 1) / 32.0, 1e-12);
  }
  EXPECT_NEAR(quantiles[15], 8.0, 1e-12);
}

}  // namespace
}  // namespace lightproof
