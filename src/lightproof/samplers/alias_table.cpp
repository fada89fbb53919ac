#include "lightproof/samplers/alias_table.h"

#include <algorithm>
#include <cmath>

namespace lightproof {
namespace {

/// Neumaier's sum: off by one rounding, however many terms.
double exact_sum(std::span<const double> values) {
  double sum = 0.0;
  double lost = 0.0;
  for (const double value : values) {
    const double next = sum + value;
    lost += std::abs(sum) >= value ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace

std::vector<std::uint64_t> whole_masses(std::span<const double> weights, unsigned bits) {
  const std::uint64_t total = weights.size() << bits;
  const double unit = exact_sum(weights) / static_cast<double>(total);
  const auto is_faint = [unit](double weight) { return weight > 0.0 && weight < unit; };
  double bright = 0.0;
  std::uint64_t left = total;
  for (const double weight : weights) {
    is_faint(weight) ? void(--left) : void(bright += weight);
  }
  const double scale = static_cast<double>(left) / bright;
  std::vector<std::uint64_t> masses(weights.size());
  double carry = 0.0;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    if (is_faint(weights[i])) {
      masses[i] = 1;
    } else {
      const double share = scale * weights[i] + carry;
      const double whole = std::max(1.0, std::floor(share));
      carry = share - whole;
      masses[i] = static_cast<std::uint64_t>(whole);
    }
    sum += masses[i];
  }
  *std::max_element(masses.begin(), masses.end()) += total - sum;  // modulo 2^64: of either sign
  return masses;
}

AliasTable::AliasTable(std::span<const double> weights) : entries_(weights.size()) {
  const std::vector<std::uint64_t> masses = whole_masses(weights, kBits);
  const auto probability = [unit = kUnit / static_cast<double>(weights.size())](std::uint64_t m) {
    return static_cast<float>(unit * static_cast<double>(m));
  };
  sweep_aliases(masses, kBits, [&](std::size_t cell, const AliasColumn& column) {
    entries_[cell] = {static_cast<std::uint32_t>(column.threshold),
                      static_cast<std::uint32_t>(column.alias), probability(masses[cell]),
                      probability(masses[column.alias])};
  });
}

}  // namespace lightproof
