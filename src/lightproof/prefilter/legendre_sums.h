// Sums of Legendre polynomials over nodes, with vectors: what a quadrature of zonal factors takes.
#pragma once

#include <span>
#include <vector>

namespace lightproof {

/// For l = 0 … degree the sum of weights[i] P_l(cosines[i]). Both spans are of one size.
std::vector<double> legendre_sums(std::span<const double> cosines, std::span<const double> weights,
                                  int degree);

}  // namespace lightproof
