// Additive recurrences: their constants from the equations that define them, their steps and
// periods, and the gaps that they leave.
#include "lightproof/points/additive_recurrence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/points/r2.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

__extension__ using Wide = unsigned __int128;

/// a^2 + k a >= 1 for a in units of 2^-64, without rounding: a (a + k 2^64) against 2^128, of which
/// only the word above 128 bits is left.
bool is_at_least_root(std::uint64_t a, std::uint64_t k) {
  const Wide square = static_cast<Wide>(a) * a;
  const Wide linear = static_cast<Wide>(a) * k << 64U;  // k a < 2^64 for a near 1/k
  return square + linear < square;                      // wraps at 2^128
}

TEST(MetallicNumbers, SolveTheirEquations) {
  const Alpha numbers[] = {kGolden, kSilver, kBronze};
  for (std::uint64_t k = 1; k <= 3; ++k) {
    const std::uint64_t a = numbers[k - 1].fraction;
    // The root is within one unit of a.
    EXPECT_TRUE(is_at_least_root(a + 1, k)) << k;
    EXPECT_FALSE(is_at_least_root(a - 1, k)) << k;
    const double root = 0.5 * (std::sqrt(static_cast<double>(k * k + 4)) - static_cast<double>(k));
    EXPECT_NEAR(numbers[k - 1].value(), root, 0x1p-52);
  }
}

// With x = 1/g, g^3 = g + 1 is x^3 + x^2 = 1.
TEST(PlasticNumber, SolvesItsEquation) {
  const double x = kPlastic.value();
  EXPECT_NEAR(x * x * x + x * x, 1.0, 4 * 0x1p-53);
  // The square of 64 bits, to 64 bits: off by at most 1.5 units.
  const Wide square = static_cast<Wide>(kPlastic.fraction) * kPlastic.fraction;
  const auto high = static_cast<std::uint64_t>(square >> 64U);
  EXPECT_LE(kPlasticSquared.fraction - high + 1U, 3U);
}

TEST(Steps, AreTheListedOnes) {
  EXPECT_EQ(nearest_step(kGolden), 2654435769U);
  EXPECT_EQ(nearest_step(kPlastic), 3242174889U);
  EXPECT_EQ(nearest_step(kPlasticSquared), 2447445414U);
  EXPECT_EQ(nearest_step(kSilver), 1779033704U);
  EXPECT_EQ(nearest_step(kBronze), 1300411462U);
}

TEST(Steps, RepeatEarlyWhereTheyAreEven) {
  EXPECT_EQ(period(nearest_step(kGolden)), kMostPoints);
  EXPECT_EQ(period(nearest_step(kPlastic)), kMostPoints);
  EXPECT_EQ(period(nearest_step(kPlasticSquared)), kMostPoints / 2);
  EXPECT_EQ(period(nearest_step(kSilver)), kMostPoints / 8);
  EXPECT_EQ(period(nearest_step(kBronze)), kMostPoints / 2);
  for (const Alpha alpha : {kGolden, kSilver, kBronze, kPlastic, kPlasticSquared}) {
    const std::uint32_t odd = nearest_odd_step(alpha);
    EXPECT_EQ(period(odd), kMostPoints);
    EXPECT_LE(std::abs(std::ldexp(alpha.value(), 32) - static_cast<double>(odd)), 1.0);
  }
}

// The period, found by going on to it.
TEST(Steps, RepeatWhereTheirPeriodSays) {
  for (const Alpha alpha : {kSilver, kBronze, kPlasticSquared}) {
    const AdditiveRecurrence recurrence = {nearest_step(alpha), 5};
    const auto end = static_cast<std::uint32_t>(period(recurrence.step));
    EXPECT_EQ(recurrence.at(end), recurrence.at(0));
    EXPECT_NE(recurrence.at(end / 2), recurrence.at(0));
    EXPECT_EQ(recurrence.at(end + 12345), recurrence.at(12345));
  }
}

TEST(RoundedSteps, RepeatPointsThatOddOnesDoNot) {
  const auto t_of = [](std::string_view set, std::uint32_t index) {
    return point_of(point_set_by_name(set).prepare(kMostPoints), index).t;
  };
  for (const std::uint32_t n : {0U, 1U, 123456789U}) {
    EXPECT_EQ(t_of("silver rounded", n), t_of("silver rounded", n + (1U << 29U)));
    EXPECT_NE(t_of("silver", n), t_of("silver", n + (1U << 29U)));
    EXPECT_EQ(t_of("bronze rounded", n), t_of("bronze rounded", n + (1U << 31U)));
    EXPECT_NE(t_of("bronze", n), t_of("bronze", n + (1U << 31U)));
  }
}

TEST(Recurrences, AreTheMultiplesOfAlphaModuloOne) {
  for (const Alpha alpha : {kGolden, kSilver, kBronze, kPlastic, kPlasticSquared}) {
    const AdditiveRecurrence recurrence = {nearest_step(alpha), 0};
    for (std::uint32_t n = 0; n < 10000; ++n) {
      const double product = n * alpha.value();
      const double exact = product - std::floor(product);
      // Half a step of 2^-32 for each n; the product in double is off by 2^-53 of itself.
      EXPECT_NEAR(from_fixed_point(recurrence.at(n)), exact, n * 0x1p-33 + 1e-12);
      EXPECT_NEAR(exact_fraction(alpha, 0, n), exact, 1e-12);
    }
  }
  EXPECT_EQ(exact_fraction(kGolden, 0x80000000U, 0), 0.5);
}

TEST(R2, IsRobertsSequence) {
  constexpr double kG = 1.32471795724474602596;
  const AnyPointSet set = point_set_by_name("R2").prepare(1000);
  for (std::uint32_t n = 0; n < 1000; ++n) {
    const double s = 0.5 + n / kG;
    const double t = 0.5 + n / (kG * kG);
    const SquarePoint point = point_of(set, n);
    EXPECT_NEAR(point.s, s - std::floor(s), 1000 * 0x1p-33);
    EXPECT_NEAR(point.t, t - std::floor(t), 1000 * 0x1p-33);
  }
}

TEST(MetallicLattices, AreRankAndMultiple) {
  struct Row {
    std::string_view set;
    double alpha;
  };
  const Row rows[] = {{"golden", (std::sqrt(5.0) - 1.0) / 2.0},
                      {"silver", std::sqrt(2.0) - 1.0},
                      {"bronze", (std::sqrt(13.0) - 3.0) / 2.0}};
  for (const Row& row : rows) {
    for (const char* form : {"", " float"}) {
      const auto points = all_of(std::string(row.set) + form, 100);
      for (std::size_t n = 0; n < points.size(); ++n) {
        const double t = static_cast<double>(n) * row.alpha;
        EXPECT_EQ(points[n].s, static_cast<double>(n) / 100.0);
        // In float: alpha's rounding and the product's, each 2^-25 of at most 64; the odd step is
        // off by up to 2^-32 for each n.
        EXPECT_NEAR(points[n].t, t - std::floor(t), 128 * 0x1p-25) << row.set << form;
      }
    }
  }
}

/// The gaps between neighbours of the first n numbers on the circle, ascending.
std::vector<std::uint64_t> gaps(std::uint32_t step, std::uint32_t n) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < n; ++i) numbers.push_back(AdditiveRecurrence{step, 0}.at(i));
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::uint64_t> all;
  for (std::uint32_t i = 0; i + 1 < n; ++i) all.push_back(numbers[i + 1] - numbers[i]);
  all.push_back(kMostPoints - numbers.back() + numbers.front());
  std::sort(all.begin(), all.end());
  return all;
}

// The three-gap theorem (Sos 1958): n multiples leave gaps of at most three lengths, the longest
// the sum of the others. For the golden ratio the longest is at most g^2 = 2.618 times the
// shortest.
TEST(Recurrences, LeaveAtMostThreeGaps) {
  for (const Alpha alpha : {kGolden, kSilver, kBronze}) {
    for (const std::uint32_t n : {2U, 10U, 100U, 1000U}) {
      std::vector<std::uint64_t> lengths = gaps(nearest_odd_step(alpha), n);
      if (alpha.fraction == kGolden.fraction) {
        EXPECT_LE(static_cast<double>(lengths.back()) / static_cast<double>(lengths.front()),
                  2.619);
      }
      lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
      EXPECT_LE(lengths.size(), 3U);
      if (lengths.size() == 3) {
        EXPECT_EQ(lengths[2], lengths[0] + lengths[1]);
      }
    }
  }
}

}  // namespace
}  // namespace lightproof::test
