#include "lightproof/prefilter/chain_interpolation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {
namespace {

std::vector<double> factors_at(double roughness, int degree, GgxWeight weight) {
  const std::optional<Lobe> lobe = ggx_lobe(roughness, weight);
  if (lobe) return zonal_factors(*lobe, degree);
  return std::vector<double>(static_cast<std::size_t>(degree) + 1, 1.0);
}

}  // namespace

InterpolationError interpolation_error(double finer, double coarser, int degree, GgxWeight weight) {
  assert(0.0 <= finer && finer < coarser && coarser <= 1.0);
  constexpr int kSteps = 32;
  const double step = (coarser - finer) / kSteps;
  std::vector<std::vector<double>> factors;
  for (int i = 0; i <= kSteps; ++i) {
    factors.push_back(factors_at(std::min(finer + i * step, 1.0), degree, weight));
  }
  InterpolationError error = {0.0, 0.0};
  double curvature = 0.0;
  for (std::size_t i = 1; i < kSteps; ++i) {
    const double fraction = static_cast<double>(i) / kSteps;
    for (std::size_t l = 0; l < factors[i].size(); ++l) {
      const double mixed = (1.0 - fraction) * factors.front()[l] + fraction * factors.back()[l];
      error.largest = std::max(error.largest, std::abs(mixed - factors[i][l]));
      const double second = factors[i - 1][l] - 2.0 * factors[i][l] + factors[i + 1][l];
      curvature = std::max(curvature, std::abs(second) / (step * step));
    }
  }
  error.bound = (coarser - finer) * (coarser - finer) / 8.0 * curvature;
  return error;
}

}  // namespace lightproof
