// The irradiance of one normal, exactly: ∫ L (n·w)+ d(omega) of a map that is constant inside each
// texel. A texel that the horizon does not cross adds L n·V, V = ∫ w d(omega) over it; where the
// horizon crosses, cosine_band.h has the closed form. The cost is that of one pass over the map;
// irradiance_map.h is for many normals.
#pragma once

#include <glm/vec3.hpp>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// E = ∫ L (n·w)+ d(omega) of red, green and blue: the map's radiance times steradian.
struct Irradiance {
  glm::dvec3 rgb;
};

/// A radiance of red, green and blue in the map's own unit, in double.
struct Radiance {
  glm::dvec3 rgb;
};

/// E/pi: what a white Lambertian surface reflects in every direction. Times the surface's colour it
/// is what is seen.
inline Radiance reflected_by_white(Irradiance irradiance) { return {irradiance.rgb / kPi}; }

/// The irradiance at the unit vector `normal` (z up). Exact but for rounding: the error is some
/// 1e-16 times the sum of all texels, and texels below the horizon add exactly 0. Time grows as W
/// H.
Irradiance irradiance(const EnvironmentMap& map, Direction normal);

}  // namespace lightproof
