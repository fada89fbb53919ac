// The GGX microfacet distribution, isotropic, and Smith's masking of its microfacets (Trowbridge &
// Reitz 1975; Smith 1967; Walter et al. 2007; Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs"). Directions are local, z along the surface's normal.
#pragma once

#include <cassert>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// alpha = roughness^2 (Burley 2012), for a roughness in (0, 1]. Roughness 0 is a mirror, which has
/// no density.
inline double ggx_alpha(double roughness) {
  assert(roughness > 0.0 && roughness <= 1.0);
  return roughness * roughness;
}

/// D(h) of a unit vector h, per steradian: area of microfacets that face h, per area of the
/// surface. ∫ D(h) (n.h) dh = 1; 0 below the surface. From h.x^2 + h.y^2, since 1 - h.z^2 has no
/// digits left where alpha is small.
inline double ggx_normal_distribution(double alpha, Direction h) {
  if (h.z < 0.0) return 0.0;
  const double a2 = alpha * alpha;
  const double stretched = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (kPi * stretched * stretched);
}

/// How the microfacets hide each other.
enum class SmithMasking {
  /// G1(v) G1(l) with G1 = mu / (mu (1 - k) + k), k = alpha/2: Schlick's rational form as fitted by
  /// Karis 2013, "Real Shading in Unreal Engine 4", for light from all around.
  karis,
  /// G1(v) G1(l) with the exact G1: masking and shadowing independent.
  separable,
  /// 1 / (1 + Lambda(v) + Lambda(l)): correlated by the height of the microfacet.
  height_correlated,
};

/// mu (1 + 2 Lambda): the length of the direction with its part along the surface scaled by alpha.
/// `mu` is its cosine to the normal, positive.
inline double smith_stretched_length(double alpha, double mu) {
  const double a2 = alpha * alpha;
  return std::sqrt(a2 + (1.0 - a2) * mu * mu);
}

/// The exact G1 of GGX: the share of the microfacets facing a direction of cosine `mu` > 0 that is
/// seen from there.
inline double smith_masking(double alpha, double mu) {
  return 2.0 * mu / (mu + smith_stretched_length(alpha, mu));
}

/// G2 / (4 mu_v mu_l), both cosines positive.
inline double smith_visibility(SmithMasking masking, double alpha, double mu_v, double mu_l) {
  switch (masking) {
    case SmithMasking::karis: {
      const double k = 0.5 * alpha;
      return 0.25 / ((mu_v * (1.0 - k) + k) * (mu_l * (1.0 - k) + k));
    }
    case SmithMasking::separable:
      return 1.0 / ((mu_v + smith_stretched_length(alpha, mu_v)) *
                    (mu_l + smith_stretched_length(alpha, mu_l)));
    case SmithMasking::height_correlated:
      return 0.5 / (mu_l * smith_stretched_length(alpha, mu_v) +
                    mu_v * smith_stretched_length(alpha, mu_l));
  }
  return 0.0;
}

/// G2: the share of microfacets that is both seen and lit, for cosines > 0.
inline double smith_masking_shadowing(SmithMasking masking, double alpha, double mu_v,
                                      double mu_l) {
  return 4.0 * mu_v * mu_l * smith_visibility(masking, alpha, mu_v, mu_l);
}

}  // namespace lightproof
