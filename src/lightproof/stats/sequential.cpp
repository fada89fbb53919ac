#include "lightproof/stats/sequential.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "lightproof/stats/saddle_point.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// log of Gamma(n + a) / (Gamma(a) a^n), less (n + a) log((n + a) / a) - n: what is left of
/// Stirling's formula.
double log_rising_remainder(double n, double a) {
  return stirling_remainder(n + a) - stirling_remainder(a) - 0.5 * std::log1p(n / a);
}

/// log E for one concentration c. By Stirling's formula
///
///   log E = sum_i o_i log(o_i / e_i) + sum_i r(n_i, c p_i) - r(N, c)
///
/// with o_i = n_i + c p_i, e_i = (N + c) p_i and the remainder r above. Both o and e sum to N + c,
/// so that every term of the first sum can be half a deviance, and none is negative.
double log_e(std::span<const double> probability, std::span<const std::uint64_t> counts,
             double samples, double c) {
  double deviances = 0.0;
  double remainders = 0.0;
  double empty = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double p = probability[i];
    if (counts[i] == 0) {
      empty += p;
      continue;
    }
    const auto n = static_cast<double>(counts[i]);
    deviances += half_deviance(n + c * p, (samples + c) * p, std::fma(-samples, p, n));
    remainders += log_rising_remainder(n, c * p);
  }
  // In an empty cell o / e = c / (N + c), whatever its p.
  deviances += empty * half_deviance(c, samples + c, -samples);
  return deviances + (remainders - log_rising_remainder(samples, c));
}

}  // namespace

SequentialTest::SequentialTest(std::span<const double> probability)
    : probability_(probability.begin(), probability.end()) {
  const double sum = std::accumulate(probability_.begin(), probability_.end(), 0.0);
  assert(std::abs(sum - 1.0) <= 1e-9);
  for (double& p : probability_) p /= sum;
  const auto possible =
      std::count_if(probability_.begin(), probability_.end(), [](double p) { return p > 0.0; });
  // From one sample's worth of prior, for all mass in a few cells, to the smallest effect. For
  // many cells log E is 2x - x^2 of its maximum at x times the best N / c, so that in steps of two
  // the better of the two nearest c has at least 8/9 of it (x = 2/3 and 4/3).
  const double dof = static_cast<double>(std::max<std::ptrdiff_t>(possible - 1, 1));
  const double largest = dof / (kSmallestSequentialEffect * kSmallestSequentialEffect);
  for (double c = 1.0; c <= largest; c *= 2.0) concentrations_.push_back(c);
}

double SequentialTest::log10_e(std::span<const std::uint64_t> counts) const {
  assert(counts.size() == probability_.size());
  std::uint64_t samples = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0 && probability_[i] <= 0.0) return INFINITY;
    samples += counts[i];
  }
  if (samples == 0) return 0.0;
  std::vector<double> logs;
  logs.reserve(concentrations_.size());
  for (const double c : concentrations_) {
    logs.push_back(log_e(probability_, counts, static_cast<double>(samples), c));
  }
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - largest);
  return (largest + std::log(sum / static_cast<double>(logs.size()))) / std::numbers::ln10;
}

double SequentialTest::minimum_detectable_effect(double alpha, double power, double samples) const {
  const auto possible =
      std::count_if(probability_.begin(), probability_.end(), [](double p) { return p > 0.0; });
  if (possible < 2) return INFINITY;
  const auto dof = static_cast<double>(possible - 1);
  const double log_enough = std::log(static_cast<double>(concentrations_.size()) / alpha);
  double least = INFINITY;
  for (const double c : concentrations_) {
    const double s = samples / (c + 1.0);
    const double critical = (1.0 + s) / s * (2.0 * log_enough + dof * std::log1p(s));
    least = std::min(least, noncentrality_beyond(dof, critical, power));
  }
  return std::sqrt(least / samples);
}

bool SequentialTest::rejects(double log10_e, double alpha) { return log10_e >= -std::log10(alpha); }

}  // namespace lightproof
