// The alias method's table as it is usually built (Vose 1991, "A linear algorithm for generating
// random numbers with a given distribution"): two work lists and floats. What builds of tables are
// compared with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lightproof::bench {

struct VoseEntry {
  float threshold;
  std::uint32_t alias;
};

inline std::vector<VoseEntry> build_vose(std::span<const float> weights) {
  double sum = 0.0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  const double scale = static_cast<double>(weights.size()) / sum;
  std::vector<float> share(weights.size());
  std::vector<std::uint32_t> small;
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    share[i] = static_cast<float>(static_cast<double>(weights[i]) * scale);
    (share[i] < 1.0F ? small : large).push_back(i);
  }
  std::vector<VoseEntry> entries(weights.size());
  while (!small.empty() && !large.empty()) {
    const std::uint32_t below = small.back();
    const std::uint32_t above = large.back();
    small.pop_back();
    entries[below] = {share[below], above};
    share[above] = (share[above] + share[below]) - 1.0F;
    if (share[above] < 1.0F) {
      large.pop_back();
      small.push_back(above);
    }
  }
  for (const std::uint32_t i : large) entries[i] = {1.0F, i};
  for (const std::uint32_t i : small) entries[i] = {1.0F, i};
  return entries;
}

}  // namespace lightproof::bench
