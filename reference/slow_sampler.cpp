#include "reference/slow_sampler.h"

#include <cmath>
#include <numeric>

#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

/// The first cell of positive mass with (mass up to and including it) / total > u; the last one of
/// positive mass if rounding leaves none.
int first_above(std::span<const double> masses, double u) {
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  double sum = 0.0;
  int last_positive = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    sum += masses[i];
    if (masses[i] <= 0.0) continue;
    last_positive = static_cast<int>(i);
    if (sum > u * total) return last_positive;
  }
  return last_positive;
}

bool entry_within(std::span<const double> masses, double u, double distance) {
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  double sum = 0.0;
  for (const double mass : masses) {
    sum += mass;
    if (std::abs(sum - u * total) <= distance * total) return true;
  }
  return u <= distance;
}

}  // namespace

SlowSampler::SlowSampler(const EnvironmentMap& map, TargetDensity target)
    : masses_(texel_masses(map, target)), rows_(row_marginal(masses_)) {}

Texel SlowSampler::sample(SquarePoint u) const {
  const int y = first_above(rows_, u.t);
  return {first_above(masses_.row(y), u.s), y};
}

bool SlowSampler::near_entry(SquarePoint u, double distance) const {
  return entry_within(rows_, u.t, distance) ||
         entry_within(masses_.row(first_above(rows_, u.t)), u.s, distance);
}

}  // namespace lightproof::reference
