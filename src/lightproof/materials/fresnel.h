// Fresnel reflectance by Schlick's approximation. Cosines are those of the angle to the normal that
// reflects: the half vector, or the surface's own where only that is known.
#pragma once

#include <algorithm>

namespace lightproof {

/// (1 - cosine)^5: how far reflectance has gone from that of normal incidence to 1.
inline double schlick_weight(double cosine) {
  const double m = std::clamp(1.0 - cosine, 0.0, 1.0);
  const double square = m * m;
  return square * square * m;
}

/// F0 + (1 - F0)(1 - cosine)^5 (Schlick 1994, "An Inexpensive BRDF Model for Physically-based
/// Rendering", eq. 24), F0 the reflectance at normal incidence.
inline double schlick_fresnel(double normal_reflectance, double cosine) {
  return normal_reflectance + (1.0 - normal_reflectance) * schlick_weight(cosine);
}

/// Schlick's Fresnel reflectance, going to max(1 - roughness, F0) instead of 1 at grazing: for
/// whole lobes, looked up by the cosine to the surface's normal (Lagarde 2011). Roughness 0 is
/// Schlick's own.
inline double schlick_fresnel_of_roughness(double normal_reflectance, double roughness,
                                           double cosine) {
  const double grazing = std::max(1.0 - roughness, normal_reflectance);
  return normal_reflectance + (grazing - normal_reflectance) * schlick_weight(cosine);
}

}  // namespace lightproof
