#include "lightproof/stats/family.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace lightproof {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

}  // namespace

std::vector<bool> holm_rejections(std::span<const double> log10_p, double alpha,
                                  std::size_t family) {
  // What is not a number is no pass: it comes first and is rejected.
  const auto key = [&](std::size_t i) { return std::isnan(log10_p[i]) ? kImpossible : log10_p[i]; };
  std::vector<std::size_t> order(log10_p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<bool> rejected(log10_p.size(), false);
  const std::size_t tests = std::max(family, order.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double level = std::log10(alpha / static_cast<double>(tests - rank));
    if (key(order[rank]) > level) break;
    rejected[order[rank]] = true;
  }
  return rejected;
}

double strictest_level(double alpha, std::size_t tests) {
  return alpha / static_cast<double>(std::max<std::size_t>(tests, 1));
}

}  // namespace lightproof
