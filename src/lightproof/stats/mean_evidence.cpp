#include "lightproof/stats/mean_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lightproof {
namespace {

constexpr int kStakes = 24;
constexpr double kNone = -std::numeric_limits<double>::infinity();

double stake(int k) { return std::ldexp(1.0, -k); }

/// c(a) of log(1+y) >= y - c(a) y^2 for y >= -a, a in (0, 1/2]; 1/2 in the limit.
double curvature(double a) { return a < 1e-4 ? 0.5 + a / 3.0 : (-a - std::log1p(-a)) / (a * a); }

/// The values' deviations from a mean, relative to it: sum, and sum of squares.
struct Deviations {
  double sum;
  double squares;

  Deviations(const ValueSums& values, double mean) {
    const auto n = static_cast<double>(values.count);
    const double scaled = values.sum / mean;
    sum = scaled - n;
    squares = std::max(0.0, values.squares / mean / mean - 2.0 * scaled + n);
  }
};

/// log10 of the average of the capitals, of which stakes that cannot be taken have none.
double log10_average(const std::vector<double>& logs) {
  double most = kNone;
  for (const double log : logs) most = std::max(most, log);
  if (!(most > kNone)) return 0.0;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - most);
  return (most + std::log(sum / kStakes)) / std::log(10.0);
}

}  // namespace

double log10_evidence_above(const ValueSums& values, double mean) {
  const Deviations off(values, mean);
  std::vector<double> logs;
  for (int k = 1; k <= kStakes; ++k) {
    const double share = stake(k);
    logs.push_back(share * off.sum - curvature(share) * share * share * off.squares);
  }
  return log10_average(logs);
}

double log10_evidence_below(const ValueSums& values, double mean, double largest) {
  const Deviations off(values, mean);
  std::vector<double> logs;
  for (int k = 1; k <= kStakes; ++k) {
    const double share = stake(k);
    const double most_lost = share * (largest / mean - 1.0);
    if (!(most_lost <= 0.5)) continue;
    logs.push_back(-share * off.sum -
                   curvature(std::max(0.0, most_lost)) * share * share * off.squares);
  }
  return log10_average(logs);
}

double detectable_by_evidence(double log10_enough, std::uint64_t count, double relative_variance,
                              double largest) {
  constexpr double kPowerQuantile = 2.3263478740408408;  // of 99 %
  if (count == 0) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(count);
  const double enough = log10_enough * std::log(10.0) + std::log(kStakes);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= kStakes; ++k) {
    const double share = stake(k);
    const double most_lost = share * std::max(1.0, largest - 1.0);
    if (!(most_lost <= 0.5)) continue;
    least =
        std::min(least, enough / (n * share) + curvature(most_lost) * share * relative_variance);
  }
  return least + kPowerQuantile * std::sqrt(relative_variance / n);
}

}  // namespace lightproof
