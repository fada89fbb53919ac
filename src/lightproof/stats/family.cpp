#include "lightproof/stats/family.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace lightproof {

std::vector<bool> holm_rejections(std::span<const double> log10_p, double alpha) {
  std::vector<std::size_t> order(log10_p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return log10_p[a] < log10_p[b]; });
  std::vector<bool> rejected(log10_p.size(), false);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double level = std::log10(alpha / static_cast<double>(order.size() - rank));
    if (!(log10_p[order[rank]] <= level)) break;
    rejected[order[rank]] = true;
  }
  return rejected;
}

double strictest_level(double alpha, std::size_t tests) {
  return alpha / static_cast<double>(std::max<std::size_t>(tests, 1));
}

}  // namespace lightproof
