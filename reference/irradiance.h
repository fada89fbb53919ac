// Irradiance of a map that is constant inside each texel, texel by texel, by quadrature alone.
#pragma once

#include <glm/vec3.hpp>

#include "lightproof/core/direction.h"
#include "lightproof/image/environment_map.h"

namespace lightproof::reference {

/// ∫ (n·w)+ d(omega) over texel (x, y) in steradian, to some 1e-15: Gauss's rule over theta, from
/// and to the horizon, and over the longitude, between the places at which the horizon enters or
/// leaves the texel.
double clamped_cosine_of_texel(Extent map, int x, int y, Direction normal);

/// The sum over all texels; for small maps.
glm::dvec3 irradiance(const EnvironmentMap& map, Direction normal);

}  // namespace lightproof::reference
