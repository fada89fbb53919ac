#include "lightproof/stats/mann_whitney.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

using Values = std::vector<double>;

double u_of(const Values& first, const Values& second) {
  double u = 0.0;
  for (const double a : first) {
    for (const double b : second) u += b > a ? 1.0 : b == a ? 0.5 : 0.0;
  }
  return u;
}

/// P(U >= u) over all ways to choose which of the values are the second set.
double enumerated_p(const Values& first, const Values& second) {
  Values all = first;
  all.insert(all.end(), second.begin(), second.end());
  const double seen = u_of(first, second);
  double ways = 0.0;
  double beyond = 0.0;
  for (std::uint32_t set = 0; set < (1U << all.size()); ++set) {
    if (static_cast<std::size_t>(std::popcount(set)) != second.size()) continue;
    Values chosen;
    Values left;
    for (std::size_t i = 0; i < all.size(); ++i) (set >> i & 1U ? chosen : left).push_back(all[i]);
    ways += 1.0;
    if (u_of(left, chosen) >= seen) beyond += 1.0;
  }
  return beyond / ways;
}

Values draws(std::uint64_t substream, std::size_t count, double steps) {
  const RandomStream stream("stats/mann-whitney", 1, substream);
  Values values;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double s = stream.point(i).s;
    values.push_back(steps > 0.0 ? std::floor(s * steps) : s);
  }
  return values;
}

struct EnumerationCase {
  const char* name;
  double steps;  ///< of the values; 0: continuous

  friend void PrintTo(const EnumerationCase& c, std::ostream* out) { *out << c.name; }
};

class MannWhitneyByEnumeration : public testing::TestWithParam<EnumerationCase> {};

TEST_P(MannWhitneyByEnumeration, HasTheSharesOfAllDivisions) {
  std::uint64_t substream = 0;
  for (std::size_t n = 1; n <= 7; ++n) {
    for (std::size_t m = 1; m <= 6; ++m) {
      const Values first = draws(substream++, n, GetParam().steps);
      const Values second = draws(substream++, m, GetParam().steps);
      const MannWhitney test = mann_whitney_larger(first, second);
      EXPECT_TRUE(test.exact);
      EXPECT_EQ(test.u, u_of(first, second));
      // At most 1716 divisions, counted exactly; what is left is the rounding of one logarithm.
      EXPECT_NEAR(std::pow(10.0, test.log10_p), enumerated_p(first, second), 1e-14)
          << n << " " << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Values, MannWhitneyByEnumeration,
                         testing::Values(EnumerationCase{"continuous", 0.0},
                                         EnumerationCase{"tied", 4.0},
                                         EnumerationCase{"equal", 1.0}),
                         [](const auto& test) { return test.param.name; });

/// Values without ties whose U, of the second set over the first, is this.
void make_sets(std::size_t n, std::size_t m, std::size_t u, Values& first, Values& second) {
  for (std::size_t i = 1; i <= n; ++i) first.push_back(static_cast<double>(i));
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t beaten = std::min(u, n);
    u -= beaten;
    second.push_back(static_cast<double>(beaten) + 0.5 + 1e-3 * static_cast<double>(k));
  }
}

struct Critical {
  std::size_t n;
  std::size_t m;
  std::size_t u;  ///< the largest U' = nm - U that a one-sided test of size .001 rejects
};

// Tables of critical values, one-sided .001 (Milton 1964; Owen 1962): U' itself is rejected, the
// next one is not.
TEST(MannWhitney, HasTheTabulatedCriticalValues) {
  constexpr Critical kTable[] = {{7, 7, 1},    {8, 8, 4},    {9, 9, 7},    {10, 10, 10},
                                 {12, 12, 20}, {15, 15, 40}, {20, 20, 88}, {10, 20, 32}};
  for (const Critical& c : kTable) {
    for (const std::size_t more : {0U, 1U}) {
      Values first;
      Values second;
      make_sets(c.n, c.m, c.n * c.m - c.u - more, first, second);
      const MannWhitney test = mann_whitney_larger(first, second);
      ASSERT_EQ(test.u, static_cast<double>(c.n * c.m - c.u - more));
      EXPECT_EQ(test.log10_p <= -3.0, more == 0) << c.n << " " << c.m << " " << test.log10_p;
    }
  }
}

TEST(MannWhitney, OfSeparateSetsHasTheLeastPValue) {
  for (const std::size_t n : {1U, 7U, 15U, 32U}) {
    Values first;
    Values second;
    make_sets(n, n, n * n, first, second);
    EXPECT_NEAR(mann_whitney_larger(first, second).log10_p, log10_least_mann_whitney(n, n), 1e-12);
    EXPECT_NEAR(mann_whitney_larger(second, first).log10_p, 0.0, 1e-12);
  }
  EXPECT_NEAR(log10_least_mann_whitney(7, 7), -std::log10(3432.0), 1e-13);
}

TEST(MannWhitney, GoesOverToTheNormalDistributionWithoutAStep) {
  for (const double steps : {0.0, 6.0}) {
    Values first = draws(1000, 32, steps);
    Values second = draws(1001, 32, steps);
    for (double& value : second) value += steps > 0.0 ? 1.0 : 0.15;
    const MannWhitney exact = mann_whitney_larger(first, second);
    EXPECT_TRUE(exact.exact);
    // Two more values, one at each end, leave the order of all others as it was.
    first.push_back(-100.0);
    second.push_back(100.0);
    const MannWhitney normal = mann_whitney_larger(first, second);
    EXPECT_FALSE(normal.exact);
    first.pop_back();
    second.pop_back();
    first.push_back(100.0);
    second.push_back(-100.0);
    const MannWhitney other = mann_whitney_larger(first, second);
    EXPECT_LT(normal.log10_p, exact.log10_p);
    EXPECT_GT(other.log10_p, exact.log10_p);
  }
}

/// The share of all orders of 40 and 40 different values with U >= u, by the recurrence of Mann and
/// Whitney in probabilities.
double recurrence_p(std::size_t n, std::size_t m, std::size_t u) {
  std::vector<std::vector<Values>> p(n + 1, std::vector<Values>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 0; k <= m; ++k) {
      p[i][k].assign(i * k + 1, 0.0);
      if (i == 0 || k == 0) {
        p[i][k][0] = 1.0;
        continue;
      }
      const double share = static_cast<double>(k) / static_cast<double>(i + k);
      for (std::size_t s = 0; s <= i * k; ++s) {
        // The largest value of all belongs to the second set, and beats i, or to the first.
        if (s >= i) p[i][k][s] += share * p[i][k - 1][s - i];
        if (s < p[i - 1][k].size()) p[i][k][s] += (1.0 - share) * p[i - 1][k][s];
      }
    }
  }
  double tail = 0.0;
  for (std::size_t s = u; s <= n * m; ++s) tail += p[n][m][s];
  return tail;
}

TEST(MannWhitney, NormalDistributionIsCloseToTheExactOneAndOnTheSafeSide) {
  for (const std::size_t u : {800U, 900U, 1000U, 1100U, 1150U}) {
    Values first;
    Values second;
    make_sets(40, 40, u, first, second);
    const MannWhitney test = mann_whitney_larger(first, second);
    ASSERT_FALSE(test.exact);
    const double exact = recurrence_p(40, 40, u);
    const double p = std::pow(10.0, test.log10_p);
    // Edgeworth's next term, from the excess kurtosis of U, 6/5 (3 + 2/n) / (2 n + 1) for two sets
    // of n; what it leaves out is of the order of its square.
    const double z = (static_cast<double>(u) - 800.5) / std::sqrt(10800.0);
    const double kurtosis = -1.2 * (3.0 + 2.0 / 40.0) / 81.0;
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::acos(-1.0));
    const double term = density * kurtosis / 24.0 * (z * z * z - 3.0 * z) / p;
    EXPECT_NEAR(exact / p, 1.0 + term, term * term + 1e-3) << u;
    if (exact >= 0.01) continue;
    EXPECT_GE(p, exact) << u;
  }
}

TEST(MannWhitney, TieCorrectionIsTheVarianceOfTheTiedRanks) {
  // 50 zeros and 50 ones, split 15/35 against 35/15: a fourfold table, whose U is hypergeometric.
  const auto set = [](std::size_t zeros, std::size_t ones) {
    Values values(zeros, 0.0);
    values.insert(values.end(), ones, 1.0);
    return values;
  };
  const MannWhitney test = mann_whitney_larger(set(35, 15), set(15, 35));
  ASSERT_FALSE(test.exact);
  // U = 1250 + 50 (k - 25), where k = 35 ones are hypergeometric of variance 50 * 50 / (4 * 99).
  const double variance = 2500.0 * 2500.0 / 396.0;
  const double z = (1750.0 - 1250.0 - 0.5) / std::sqrt(variance);
  EXPECT_NEAR(std::pow(10.0, test.log10_p), 0.5 * std::erfc(z / std::sqrt(2.0)), 1e-12);
}

TEST(MannWhitney, OfNothingSaysNothing) {
  EXPECT_EQ(mann_whitney_larger({}, {}).log10_p, 0.0);
  EXPECT_EQ(mann_whitney_larger(Values{1.0}, {}).log10_p, 0.0);
  EXPECT_EQ(log10_mann_whitney_different(Values(40, 1.0), Values(40, 1.0)), 0.0);
}

TEST(MannWhitney, TwoSidedIsTwiceTheSmallerSide) {
  const Values low = {1.0, 2.0, 3.0};
  const Values high = {4.0, 5.0, 6.0};
  EXPECT_NEAR(log10_mann_whitney_different(low, high), std::log10(0.1), 1e-14);
  EXPECT_NEAR(log10_mann_whitney_different(high, low), std::log10(0.1), 1e-14);
}

}  // namespace
}  // namespace lightproof
