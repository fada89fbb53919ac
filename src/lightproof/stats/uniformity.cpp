#include "lightproof/stats/uniformity.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/trapezoidal.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "lightproof/core/memo.h"
#include "lightproof/stats/critical_value.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

std::uint64_t total_of(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// The uniform distribution F at the edges between so many equal cells, and F (1 - F).
struct UniformEdges {
  explicit UniformEdges(std::size_t cells) {
    for (std::size_t edge = 1; edge < cells; ++edge) {
      const double at = static_cast<double>(edge) / static_cast<double>(cells);
      value.push_back(at);
      variance.push_back(at * (1.0 - at));
    }
  }
  std::vector<double> value;
  std::vector<double> variance;
};

/// The sum of (F_N - F)^2 / (F (1-F)) over the edges, from the first to the last.
double sum_over_edges(std::span<const std::uint64_t> counts, double total,
                      const UniformEdges& edges) {
  constexpr std::size_t kAtOnce = 512;
  std::array<double, kAtOnce> terms;
  double sum = 0.0;
  std::uint64_t below = 0;
  for (std::size_t first = 0; first < edges.value.size(); first += kAtOnce) {
    const std::size_t number = std::min(kAtOnce, edges.value.size() - first);
    // Three loops, of which the compiler makes vectors of the one with the divisions.
    for (std::size_t i = 0; i < number; ++i) {
      below += counts[first + i];
      terms[i] = static_cast<double>(below);
    }
    for (std::size_t i = 0; i < number; ++i) {
      const double d = terms[i] / total - edges.value[first + i];
      terms[i] = d * d / edges.variance[first + i];
    }
    for (std::size_t i = 0; i < number; ++i) sum += terms[i];
  }
  return sum;
}

/// A^2 is the sum of squared normals over j (j + 1); far out the first of them decides:
/// P(A^2 > a) -> sqrt(3) P(chi^2_1 > 2 a) (Zolotarev 1961), 2 % off at a = 15.
double tail_of_first_normal(double a) {
  return std::log10(std::numbers::sqrt3) + log10_chi_square_tail(2.0 * a, 1.0);
}

/// P(A^2 < a): the series of Anderson and Darling (1952), each term an integral over one variable.
double anderson_darling_cdf(double a) {
  constexpr double kLastChange = 1e-10;
  double sum = 0.0;
  double binomial = 1.0;  // (-1/2 over j), with its sign
  for (int j = 0; j < 40; ++j) {
    const double order = 4.0 * j + 1.0;
    const double t = order * order * std::numbers::pi * std::numbers::pi / (8.0 * a);
    // ∫ from 0 to infinity, beyond the end of which exp(-64) is left. The trapezoidal rule
    // converges geometrically for so smooth a bell: halving the step squares the error, so that it
    // is below a double's rounding where the last halving changed no more than the root of that.
    const auto bell = [&](double w) { return std::exp(a / (8.0 * (w * w + 1.0)) - t * w * w); };
    const double integral =
        boost::math::quadrature::trapezoidal(bell, 0.0, 8.0 / std::sqrt(t), kLastChange);
    const double term = binomial * order * std::exp(-t) * integral;
    sum += term;
    if (std::abs(term) < 1e-17 * std::abs(sum)) break;
    binomial *= -(j + 0.5) / (j + 1.0);
  }
  return std::sqrt(2.0 * std::numbers::pi) / a * sum;
}

double critical_kuiper(double level) {
  static Memo<1> memo;
  return memo({level}, [](const auto& arguments) {
    return critical_value(log10_kuiper_tail, std::log10(arguments[0]));
  });
}

double critical_anderson_darling(double level) {
  static Memo<1> memo;
  return memo({level}, [](const auto& arguments) {
    return critical_value(log10_anderson_darling_tail, std::log10(arguments[0]));
  });
}

/// The standard normal quantile of `power`.
double quantile(double power) { return minimum_detectable_z(1.0, power); }

}  // namespace

double minimum_detectable_kuiper_distance(double level, double power, double samples) {
  const double critical = critical_kuiper(level);
  return (critical + 0.5 * quantile(power)) / std::sqrt(samples);
}

double kuiper_power(double distance, double level, double samples) {
  const double critical = critical_kuiper(level);
  return normal_cdf(2.0 * (distance * std::sqrt(samples) - critical));
}

double anderson_darling_power(double distance, double level, double samples) {
  const double critical = critical_anderson_darling(level);
  return normal_cdf(std::numbers::sqrt2 * (distance * std::sqrt(samples) - std::sqrt(critical)));
}

double minimum_detectable_anderson_darling_distance(double level, double power, double samples) {
  const double critical = critical_anderson_darling(level);
  return (std::sqrt(critical) + std::sqrt(0.5) * quantile(power)) / std::sqrt(samples);
}

double log10_kolmogorov_tail(double x) {
  // 2 sum_j (-1)^(j-1) exp(-2 j^2 x^2); below 0.2 it is 1 to twelve digits.
  if (x < 0.2) return 0.0;
  double rest = 1.0;  // terms relative to the first
  double sign = -1.0;
  for (int j = 2; j < 20; ++j, sign = -sign) {
    rest += sign * std::exp(-2.0 * (static_cast<double>(j) * j - 1.0) * x * x);
  }
  const double log10_q = (std::log(2.0 * rest) - 2.0 * x * x) * std::numbers::log10e;
  return std::min(0.0, log10_q);
}

double log10_kuiper_tail(double v) {
  // Q(v) = 2 sum_j (4 j^2 v^2 - 1) exp(-2 j^2 v^2); below 0.4 it is 1 to seven digits.
  if (v < 0.4) return 0.0;
  const double square = v * v;
  const double first = 2.0 * (4.0 * square - 1.0);
  double rest = 1.0;  // terms relative to exp(-2 v^2) first
  for (int j = 2; j < 20; ++j) {
    const double j2 = static_cast<double>(j) * j;
    rest += (4.0 * j2 * square - 1.0) / (4.0 * square - 1.0) * std::exp(-2.0 * (j2 - 1.0) * square);
  }
  const double log10_q = (std::log(first) + std::log(rest) - 2.0 * square) * std::numbers::log10e;
  return std::min(0.0, log10_q);
}

double log10_anderson_darling_tail(double a) {
  if (a <= 0.05) return 0.0;
  constexpr double kSeriesEnd = 15.0;
  if (a < kSeriesEnd) return std::log10(1.0 - anderson_darling_cdf(a));
  return tail_of_first_normal(a);
}

UniformityTest kuiper_test(std::span<const std::uint64_t> counts) {
  const std::uint64_t total = total_of(counts);
  if (total == 0) return {};
  const auto samples = static_cast<double>(total);
  const auto cells = static_cast<double>(counts.size());
  double above = 0.0;
  double below = 0.0;
  std::uint64_t counted = 0;
  // F_N is constant over cells without samples: it is highest above F at the first of their edges,
  // and lowest below it at the last.
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    if (counts[cell] == 0 && cell + 1 < counts.size()) continue;
    const double before = static_cast<double>(cell) / cells;
    below = std::max(below, before - static_cast<double>(counted) / samples);
    counted += counts[cell];
    const double after = static_cast<double>(cell + 1) / cells;
    above = std::max(above, static_cast<double>(counted) / samples - after);
  }
  const double root = std::sqrt(static_cast<double>(total));
  const double v = (root + 0.155 + 0.24 / root) * (above + below);
  return {v, log10_kuiper_tail(v), above + below};
}

UniformityTest anderson_darling_test(std::span<const std::uint64_t> counts) {
  const std::uint64_t total = total_of(counts);
  if (total == 0) return {};
  static const UniformEdges usual(kUniformCells);
  const auto samples = static_cast<double>(total);
  const double sum = counts.size() == kUniformCells
                         ? sum_over_edges(counts, samples, usual)
                         : sum_over_edges(counts, samples, UniformEdges(counts.size()));
  const double a = static_cast<double>(total) / static_cast<double>(counts.size()) * sum;
  return {a, log10_anderson_darling_tail(a), std::sqrt(sum / static_cast<double>(counts.size()))};
}

}  // namespace lightproof
