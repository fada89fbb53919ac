// The second part of the split sum: what a GGX microfacet BRDF reflects of a white sky, as a linear
// function of the reflectance at normal incidence. Karis 2013, "Real Shading in Unreal Engine 4";
// a texture over the cosine to the view and the perceptual roughness R, alpha = R^2.
#pragma once

#include <cstdint>

#include "lightproof/core/grid.h"

namespace lightproof {

/// The light that is reflected is F0 scale + bias, with Schlick's Fresnel reflectance.
struct ScaleBias {
  double scale;  ///< A: the integral of 1 - (1 - v·h)^5
  double bias;   ///< B: the integral of (1 - v·h)^5

  /// The whole at a reflectance of F0.
  double reflected(double f0) const { return f0 * scale + bias; }
};

/// The masking and shadowing term G.
enum class Masking {
  karis,              ///< Schlick's fit, one factor each for view and light, k = R^2/2
  separable,          ///< Smith's, one factor each for view and light
  height_correlated,  ///< Smith's, of one height
};

/// The points that the sum goes over: n = first … first + count - 1 of the Hammersley set of
/// `count`.
struct HammersleyRange {
  std::uint32_t count = 1024;
  std::uint32_t first = 0;

  /// The lecture's loop, from 1 to N.
  static constexpr HammersleyRange published(std::uint32_t count) { return {count, 1}; }
};

/// Scale and bias by the lecture's sum over half-vectors. `cosine` in (0,1]: at 0 the published
/// weight is 0/0.
ScaleBias integrate_brdf(double cosine, double roughness, Masking masking, HammersleyRange points);

/// Scale and bias by quadrature, with an error below 2e-6, for a cosine and a roughness in [0,1].
ScaleBias integrate_brdf(double cosine, double roughness, Masking masking);

/// The whole map, by quadrature with an error below 5e-5: texel (x, y) at cosine (x + 1/2)/width
/// and roughness (y + 1/2)/height.
Grid<ScaleBias> brdf_map(Extent extent, Masking masking);

/// The map of scale and bias by the lecture's sum over these points.
Grid<ScaleBias> brdf_map(Extent extent, Masking masking, HammersleyRange points);

}  // namespace lightproof
