// What an engine finds in a map with levels: texture look-ups by direction, as graphics libraries
// define them.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/image/map_levels.h"

namespace lightproof {

/// Interpolates bilinearly between the centres of texels of one level, at a world direction (z up)
/// of any length but 0. Latitude-longitude maps wrap around and are clamped at the poles. Cubes are
/// seamless: across an edge the texels of the next face count, and at a corner, where three texels
/// meet, their mean stands for the fourth (OpenGL 4.6, section 8.14.3; Vulkan 1.3, "Cube Map Edge
/// Handling").
Rgb look_up_bilinear(const MapLevels& map, int level, Direction direction);

/// Interpolates linearly between the levels around `lod`, which is clamped to the map's levels.
Rgb look_up_trilinear(const MapLevels& map, double lod, Direction direction);

}  // namespace lightproof
