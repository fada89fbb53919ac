#include "lightproof/stats/uniformity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lightproof/core/random.h"
#include "uniformity.h"

namespace lightproof {
namespace {

// Percentage points of Kuiper's V* (Stephens 1970, table 1), given to three decimals: the
// distribution falls by up to 4 v of itself per unit, so half a unit of the last one is 0.4 % of p.
TEST(KuiperTail, HasTheTabulatedPercentagePoints) {
  const std::vector<std::pair<double, double>> points = {
      {1.620, 0.10}, {1.747, 0.05}, {1.862, 0.025}, {2.001, 0.01}};
  for (const auto& [v, p] : points) {
    EXPECT_NEAR(std::pow(10.0, log10_kuiper_tail(v)) / p, 1.0, 0.005) << v;
  }
}

// Critical values of sqrt(N) D for large N (Smirnov 1948).
TEST(KolmogorovTail, HasTheTabulatedPercentagePoints) {
  for (const auto& [x, p] : {std::pair(1.2238, 0.10), std::pair(1.3581, 0.05),
                             std::pair(1.6276, 0.01), std::pair(1.9495, 0.001)}) {
    EXPECT_NEAR(std::pow(10.0, log10_kolmogorov_tail(x)) / p, 1.0, 0.002) << x;
  }
  EXPECT_EQ(log10_kolmogorov_tail(0.1), 0.0);
  // 2 (e^-1/2 - e^-2 + e^-9/2 - e^-8 + ...), where several terms count.
  EXPECT_NEAR(std::pow(10.0, log10_kolmogorov_tail(0.5)), 0.9639452436648751, 1e-12);
  EXPECT_NEAR(log10_kolmogorov_tail(30.0), std::log10(2.0) - 1800.0 / std::log(10.0), 1e-9);
}

TEST(KuiperTail, KeepsItsLogarithmFarOut) {
  // The first term alone: 2 (4 v^2 - 1) exp(-2 v^2).
  const double v = 40.0;
  EXPECT_NEAR(log10_kuiper_tail(v),
              (std::log(2.0 * (4.0 * v * v - 1.0)) - 2.0 * v * v) / std::log(10.0), 1e-9);
  EXPECT_EQ(log10_kuiper_tail(0.0), 0.0);
}

// Percentage points of A^2 (Lewis 1961; Marsaglia & Marsaglia 2004 give 2.4924 and 3.8781 to four
// decimals; p falls by 1.2 of itself per unit).
TEST(AndersonDarlingTail, HasTheTabulatedPercentagePoints) {
  EXPECT_NEAR(std::pow(10.0, log10_anderson_darling_tail(2.4924)), 0.05, 1e-5);
  EXPECT_NEAR(std::pow(10.0, log10_anderson_darling_tail(3.8781)), 0.01, 1e-6);
  EXPECT_NEAR(std::pow(10.0, log10_anderson_darling_tail(1.933)), 0.10, 1e-4);
}

// The inverse Laplace transform of (1 - E[exp(-s A^2)]) / s by Talbot's contour with 60 digits
// (Python's mpmath), where E[exp(-s A^2)] = prod_j (1 + 2s / (j (j+1)))^-1/2. The library subtracts
// its series from 1: what is left of p by the roundings of ten factors and sums.
TEST(AndersonDarlingTail, LosesNoMoreDigitsThanOneMinusItsSeries) {
  const std::vector<std::pair<double, double>> values = {
      {0.25, -0.01305219838353324517},     {1.0, -0.44700749405308730274},
      {2.4921875, -1.3009357205737561761}, {3.875, -1.9984695272599975024},
      {7.5, -3.7130043026553568918},       {11.0, -5.3141595965861735138},
      {14.5, -6.8929229291618569177},      {14.875, -7.0612222939912323462}};
  for (const auto& [a, log10_p] : values) {
    const double rounding = 10.0 * 0x1p-53 / std::pow(10.0, log10_p) * std::numbers::log10e;
    EXPECT_NEAR(log10_anderson_darling_tail(a), log10_p, rounding) << a;
  }
}

// The series ends where the first of the weighted normals takes over.
TEST(AndersonDarlingTail, IsContinuousWhereItsFormulaChanges) {
  const double below = log10_anderson_darling_tail(15.0 - 1e-9);
  const double above = log10_anderson_darling_tail(15.0 + 1e-9);
  EXPECT_NEAR(below, above, 0.01);  // 2 % of p
  EXPECT_LT(log10_anderson_darling_tail(2000.0), -800.0);
}

std::vector<std::uint64_t> counts_of(const RandomStream& stream, std::uint64_t samples,
                                     double power) {
  std::vector<std::uint64_t> counts(kUniformCells);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double u = std::pow(stream.point(i).s, power);
    ++counts[static_cast<std::size_t>(u * static_cast<double>(kUniformCells))];
  }
  return counts;
}

// With the same operations in the same order at every edge: not a bit differs.
TEST(Uniformity, IsItsDefinitionAtEveryEdge) {
  const RandomStream stream("Uniformity at every edge", 1);
  for (const std::size_t cells :
       {std::size_t{2}, std::size_t{7}, std::size_t{1000}, kUniformCells}) {
    for (const std::uint64_t samples : {1ULL, 50ULL, 200000ULL}) {
      std::vector<std::uint64_t> counts(cells);
      for (std::uint64_t i = 0; i < samples; ++i) {
        ++counts[static_cast<std::size_t>(stream.point(i).s * static_cast<double>(cells))];
      }
      const auto total = static_cast<double>(samples);
      const auto number = static_cast<double>(cells);
      double above = 0.0;
      double below = 0.0;
      double sum = 0.0;
      std::uint64_t counted = 0;
      for (std::size_t cell = 0; cell + 1 < cells; ++cell) {
        counted += counts[cell];
        const double exact = static_cast<double>(cell + 1) / number;
        const double d = static_cast<double>(counted) / total - exact;
        above = std::max(above, d);
        below = std::max(below, -d);
        sum += d * d / (exact * (1.0 - exact));
      }
      EXPECT_EQ(kuiper_test(counts).distance, above + below) << cells << ", " << samples;
      EXPECT_EQ(anderson_darling_test(counts).distance, std::sqrt(sum / number))
          << cells << ", " << samples;
    }
  }
}

TEST(UniformityCalibration, PValuesOfUniformNumbersAreUniform) {
  const RandomStream all("UniformityCalibration", 1);
  std::vector<double> kuiper;
  std::vector<double> anderson;
  for (std::uint64_t replicate = 0; replicate < 2000; ++replicate) {
    const auto counts = counts_of(all.substream(replicate), 4096, 1.0);
    kuiper.push_back(kuiper_test(counts).log10_p);
    anderson.push_back(anderson_darling_test(counts).log10_p);
  }
  expect_uniform(kuiper);
  expect_uniform(anderson);
}

TEST(Uniformity, RejectsNumbersThatAreNot) {
  const RandomStream stream("Uniformity", 1);
  const auto counts = counts_of(stream, 100000, 1.05);  // F = u^(1/1.05): 1.8 % off at most
  EXPECT_LT(kuiper_test(counts).log10_p, -10.0);
  EXPECT_LT(anderson_darling_test(counts).log10_p, -10.0);
}

}  // namespace
}  // namespace lightproof
