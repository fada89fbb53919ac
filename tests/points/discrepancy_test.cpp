// Discrepancies against other ways to compute them, and the closed forms of Hammersley's points.
#include "lightproof/points/discrepancy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/moments.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

double share(const std::vector<SquarePoint>& points, double a, double b, bool shut) {
  const auto inside = [&](SquarePoint p) {
    return shut ? p.s <= a && p.t <= b : p.s < a && p.t < b;
  };
  return static_cast<double>(std::count_if(points.begin(), points.end(), inside)) /
         static_cast<double>(points.size());
}

/// By definition: the supremum is reached, or approached, at a corner whose coordinates are those
/// of points, or 1.
double star_discrepancy_by_counting(const std::vector<SquarePoint>& points) {
  std::vector<double> s = {1.0};
  std::vector<double> t = {1.0};
  for (const SquarePoint p : points) {
    s.push_back(p.s);
    t.push_back(p.t);
  }
  double largest = 0.0;
  for (const double a : s) {
    for (const double b : t) {
      largest = std::max(
          {largest, share(points, a, b, true) - a * b, a * b - share(points, a, b, false)});
    }
  }
  return largest;
}

/// The mean square over the corners of the cells between points' coordinates: inside of a cell the
/// share is constant, and the square of a constant less ab integrates in closed form.
double l2_star_discrepancy_by_cells(const std::vector<SquarePoint>& points) {
  std::vector<double> s = {0.0, 1.0};
  std::vector<double> t = {0.0, 1.0};
  for (const SquarePoint p : points) {
    s.push_back(p.s);
    t.push_back(p.t);
  }
  std::sort(s.begin(), s.end());
  std::sort(t.begin(), t.end());
  const auto power = [](double from, double to, int n) {
    return (std::pow(to, n) - std::pow(from, n)) / n;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    for (std::size_t j = 0; j + 1 < t.size(); ++j) {
      if (s[i] == s[i + 1] || t[j] == t[j + 1]) continue;
      const double inside = share(points, s[i], t[j], true);
      const auto area = [&](int n) { return power(s[i], s[i + 1], n) * power(t[j], t[j + 1], n); };
      sum += inside * inside * area(1) - 2.0 * inside * area(2) + area(3);
    }
  }
  return std::sqrt(sum);
}

TEST(Discrepancy, IsWhatItsDefinitionSays) {
  for (const PointSetInfo& info : point_sets()) {
    for (const std::uint64_t count : {1U, 2U, 7U, 32U}) {
      const auto points = all_of(info.name, count, 1U);
      // Some thousand additions of numbers up to 1.
      EXPECT_NEAR(star_discrepancy(points), star_discrepancy_by_counting(points), 1e-12)
          << info.name;
      EXPECT_NEAR(l2_star_discrepancy(points), l2_star_discrepancy_by_cells(points), 1e-9)
          << info.name;
    }
  }
}

TEST(Discrepancy, IsKnownOfOnePoint) {
  const std::vector<SquarePoint> middle = {{0.5, 0.5}};
  // The box up to (1/2, 1/2) holds the point: 1 - 1/4. Unshut, up to (1/2, 1) it holds none: 1/2.
  EXPECT_DOUBLE_EQ(star_discrepancy(middle), 0.75);
  // 1/9 - (3/4)^2/2 + 1/4.
  EXPECT_DOUBLE_EQ(l2_star_discrepancy(middle), std::sqrt(1.0 / 9.0 - 9.0 / 32.0 + 0.25));
}

TEST(Discrepancy, CountsPointsThatCoincide) {
  const std::vector<SquarePoint> points = {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.25}, {0.25, 0.5}};
  EXPECT_DOUBLE_EQ(star_discrepancy(points), star_discrepancy_by_counting(points));
  EXPECT_NEAR(l2_star_discrepancy(points), l2_star_discrepancy_by_cells(points), 1e-12);
}

// N D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) (De Clerck 1986), from m = 2 on; (N L2)^2 = m^2/64 + 29m/192
// + 3/8 - m/(16 2^m) + 1/(4 2^m) - 1/(72 4^m) (Vilenkin 1967, Halton and Zaremba 1969).
TEST(Hammersley, HasTheDiscrepanciesOfItsClosedForms) {
  for (int m = 0; m <= 10; ++m) {
    const double n = std::ldexp(1.0, m);
    const auto points = all_of("hammersley", std::uint64_t{1} << m);
    if (m >= 2) {
      const double sign = m % 2 == 0 ? 1.0 : -1.0;
      EXPECT_NEAR(n * star_discrepancy(points), m / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * n), 1e-9)
          << m;
    }
    const double scaled = n * l2_star_discrepancy(points);
    const double square = m * m / 64.0 + 29.0 * m / 192.0 + 3.0 / 8.0 - m / (16.0 * n) +
                          1.0 / (4.0 * n) - 1.0 / (72.0 * n * n);
    // Sums of N^2 terms round by less than 2^-53 each.
    EXPECT_NEAR(scaled * scaled, square, n * n * n * 0x1p-53 + 1e-12) << m;
  }
}

// N D* <= (m + 3)/2, without its fraction, for every (0,m,2)-net in base 2 (Niederreiter 1992,
// section 4.1), scrambled ones, too.
TEST(Nets, StayBelowNiederreitersBound) {
  for (unsigned m = 0; m <= 10; ++m) {
    const std::uint64_t count = std::uint64_t{1} << m;
    const double bound = std::floor((m + 3.0) / 2.0);
    const auto scaled = [&](std::string_view set, PointSeed seed) {
      return static_cast<double>(count) * star_discrepancy(all_of(set, count, seed));
    };
    EXPECT_LE(scaled("hammersley from 1", {}), bound);
    EXPECT_LE(scaled("sobol", {}), bound);
    for (std::uint64_t seed = 0; seed < 5; ++seed) EXPECT_LE(scaled("sobol", seed), bound) << m;
  }
}

// Of 1024 independent points the root of the mean square 5/(36 N) is 11.9/N. Hammersley's, the
// largest of these, have 1.86/N by their closed form.
TEST(LatticesAndNets, AreMoreEvenThanRandomPoints) {
  constexpr std::uint64_t kCount = 1024;
  const double random = std::sqrt(5.0 / (36.0 * kCount));
  for (const PointSetInfo& info : point_sets()) {
    if (info.kind != PointKind::lattice && info.kind != PointKind::net) continue;
    EXPECT_LT(l2_star_discrepancy(all_of(info.name, kCount)), random / 5.0) << info.name;
  }
}

// 1000 sets of 64 points. The squares scatter about their mean by less than the mean itself (L2^2
// is a weighted sum of squares), so that 6 standard errors are 20 % of it at most.
TEST(RandomPoints, HaveTheExactMeanSquareOfDiscrepancies) {
  constexpr std::uint64_t kCount = 64;
  Moments squares;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const double value = l2_star_discrepancy(all_of("philox", kCount, seed));
    squares.add(value * value);
  }
  const double exact = 5.0 / (36.0 * kCount);
  EXPECT_NEAR(squares.mean(), exact, 6.0 * squares.standard_error());
  EXPECT_LT(squares.standard_error(), exact / std::sqrt(1000.0));
}

}  // namespace
}  // namespace lightproof::test
