// Quadrature of the integrals of brdf_map.h for many view angles at once, with vectors.
#pragma once

#include <span>
#include <vector>

#include "lightproof/prefilter/brdf_map.h"

namespace lightproof {

/// Gauss-Legendre nodes for half-vectors: in the azimuth to the view, and in the cosine of an angle
/// chi with tan(theta) = alpha tan(chi), which spreads the distribution evenly.
///
/// Along a meridian the half-vectors whose mirrored light stands above the horizon end at a chi
/// that is known in closed form; up to there, the integrand is smooth. It rises steeply from the
/// horizon, where the nodes lie closest: at w = w_0 + (1 - w_0) x^3 (4 - 3x) for nodes x in [0,1],
/// which undoes the square root at w = cos(chi) = 1 as well. In azimuth there is an edge at 90
/// degrees to the view for grazing views, and none else.
class BrdfQuadrature {
 public:
  /// So many nodes in each quarter of the azimuth, and along each meridian.
  BrdfQuadrature(int around, int along);

  /// results[i] at cosines[i]; both of one size.
  void integrate(std::span<const double> cosines, double roughness, Masking masking,
                 std::span<ScaleBias> results) const;

 private:
  struct Node {
    double position;
    double weight;
  };

  std::vector<Node> around_;  ///< cosine of the azimuth, and weight
  std::vector<Node> along_;   ///< x^3 (4 - 3x), and its derivative times the weight
};

}  // namespace lightproof
