#include "lightproof/stats/mann_whitney.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// Twice the ranks of all values, `first` before `second`: whole numbers even where ties share
/// their mean rank.
struct Ranks {
  std::vector<std::size_t> doubled;
  double ties = 0.0;  ///< sum of t^3 - t over the groups of t equal values
};

Ranks ranks_of(std::span<const double> first, std::span<const double> second) {
  std::vector<double> values(first.begin(), first.end());
  values.insert(values.end(), second.begin(), second.end());
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  Ranks ranks;
  for (const double value : values) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
    // Ranks low + 1 … high have the mean (low + 1 + high) / 2.
    ranks.doubled.push_back(
        static_cast<std::size_t>((low - sorted.begin()) + 1 + (high - sorted.begin())));
    const auto equal = static_cast<double>(high - low);
    ranks.ties += equal * equal - 1.0;  // once for each of the t values
  }
  return ranks;
}

std::size_t sum(std::span<const std::size_t> values) {
  return std::accumulate(values.begin(), values.end(), std::size_t{0});
}

/// log10 of the share of all choices of `count` ranks whose sum is at least `least`. Counts of
/// choices are sums of positive numbers, so that doubles keep their digits.
double log10_exact_tail(std::span<const std::size_t> ranks, std::size_t count, std::size_t least) {
  const std::size_t sums = sum(ranks) + 1;
  std::vector<std::vector<double>> choices(count + 1, std::vector<double>(sums, 0.0));
  choices[0][0] = 1.0;
  for (const std::size_t rank : ranks) {
    for (std::size_t chosen = count; chosen >= 1; --chosen) {
      for (std::size_t s = rank; s < sums; ++s) {
        choices[chosen][s] += choices[chosen - 1][s - rank];
      }
    }
  }
  const std::vector<double>& all = choices[count];
  const auto from = all.begin() + static_cast<std::ptrdiff_t>(least);
  return std::log10(std::accumulate(from, all.end(), 0.0) /
                    std::accumulate(all.begin(), all.end(), 0.0));
}

/// log10 P(standard normal >= z).
double log10_upper_normal(double z) {
  if (z < 0.0) return std::log1p(-normal_cdf(z)) / std::numbers::ln10;
  return log10_normal_tails(z) - std::numbers::ln2 / std::numbers::ln10;
}

/// Lehmann (1975), Nonparametrics, 1.33: the variance of U, reduced by ties.
double log10_normal_tail(double u, double n, double m, double ties) {
  const double all = n + m;
  const double variance = n * m / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
  if (variance <= 0.0) return 0.0;  // all values are equal
  return log10_upper_normal((u - 0.5 * n * m - 0.5) / std::sqrt(variance));
}

double log_factorial(std::size_t n) { return std::lgamma(static_cast<double>(n) + 1.0); }

}  // namespace

MannWhitney mann_whitney_larger(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty()) return {0.0, 0.0, true};
  const Ranks ranks = ranks_of(first, second);
  const std::size_t doubled_sum = sum(std::span(ranks.doubled).subspan(first.size()));
  const auto n = static_cast<double>(first.size());
  const auto m = static_cast<double>(second.size());
  const double u = 0.5 * static_cast<double>(doubled_sum) - 0.5 * m * (m + 1.0);
  if (ranks.doubled.size() <= kLargestExactRanks) {
    return {u, log10_exact_tail(ranks.doubled, second.size(), doubled_sum), true};
  }
  return {u, log10_normal_tail(u, n, m, ranks.ties), false};
}

double log10_mann_whitney_different(std::span<const double> first, std::span<const double> second) {
  const double smaller = std::min(mann_whitney_larger(first, second).log10_p,
                                  mann_whitney_larger(second, first).log10_p);
  return std::min(0.0, smaller + std::numbers::ln2 / std::numbers::ln10);
}

double log10_least_mann_whitney(std::size_t first, std::size_t second) {
  return (log_factorial(first) + log_factorial(second) - log_factorial(first + second)) /
         std::numbers::ln10;
}

}  // namespace lightproof
