// From irradiance to what is seen of a diffuse surface, as published and as it should be.
#pragma once

#include "lightproof/prefilter/irradiance.h"

namespace lightproof {

/// The radiance that a diffuse surface of this colour (albedo, each channel in [0,1]) reflects:
/// c/pi E, times the share of the light that its specular coat lets through.
inline Radiance diffuse_reflection(Irradiance irradiance, glm::dvec3 colour,
                                   double transmitted = 1.0) {
  return {transmitted / kPi * colour * irradiance.rgb};
}

/// As published in a course's text, c pi times the integral of L cos: too bright by a factor of
/// pi^2. The course's program stores pi times the mean of L under cosine sampling, which is E.
inline Radiance diffuse_reflection_published(Irradiance irradiance, glm::dvec3 colour) {
  return {kPi * colour * irradiance.rgb};
}

/// The same text integrates n·w L over the hemisphere opposite the normal, where n·w is negative:
/// -E(-n), which is neither the sign nor the light of the surface's own side.
inline Irradiance opposite_hemisphere_published(const EnvironmentMap& map, Direction normal) {
  return {-irradiance(map, -normal).rgb};
}

/// The share of constant light, weighted by the cosine, that a coat of Schlick's reflectance
/// F = f0 + (1 - f0)(1 - cos)^5 lets through: (1 - f0) 20/21. Published as 1, "1 - F is very close
/// to 1"; for f0 = 0.04 that is 9.4 % too much.
inline double mean_transmittance(double f0) { return (1.0 - f0) * 20.0 / 21.0; }
inline double mean_transmittance_published(double /*f0*/) { return 1.0; }

}  // namespace lightproof
