#include "lightproof/gate/residuals.h"

#include <cmath>

namespace lightproof {

Grid<double> residuals(const Expectation& expectation, const Draws& draws) {
  Grid<double> residual(kGateBins);
  const double n = static_cast<double>(draws.samples);
  for (std::size_t i = 0; i < residual.values().size(); ++i) {
    const double expected = n * expectation.bins.values()[i];
    const double observed = static_cast<double>(draws.bins.values()[i]);
    residual.values()[i] = expected > 0.0 ? (observed - expected) / std::sqrt(expected) : observed;
  }
  return residual;
}

std::vector<double> cumulative_divergence(const Expectation& expectation, const Draws& draws) {
  std::vector<double> sums;
  double sum = 0.0;
  const double n = static_cast<double>(draws.samples);
  for (int y = 0; y < draws.texels.extent().height; ++y) {
    const double expected = n * expectation.rows[static_cast<std::size_t>(y)];
    double observed = 0.0;
    for (const std::uint64_t count : draws.texels.row(y)) observed += static_cast<double>(count);
    const double d = observed - expected;
    sum += expected > 0.0 ? d * d / expected : observed;
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace lightproof
