// Maps for what knows texels of latitude and longitude only. Samplers, the gate and its reference
// take a map in any mapping; whatever integrates over rows between parallels asks here first.
#pragma once

#include <string_view>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// Throws InputError, which names the map, its mapping and what would help, unless the map's texels
/// are those of latitude and longitude in Lightproof's own frame. `user` is who needs them so, as
/// the subject of a sentence: "irradiance".
void require_lat_long(const EnvironmentMap& map, std::string_view user);

/// The radiance of a map that passes require_lat_long().
const Grid<Rgb>& lat_long_radiance(const EnvironmentMap& map, std::string_view user);

/// The map in texels of latitude and longitude, with a note that says so; unchanged if it has them.
/// Texels of octahedral maps and cubes go to the nearest ones of a map of 2n x n of n x n, or of
/// 4n x 2n of faces of n x n; nodes are interpolated bilinearly; columns that are shifted by a part
/// of a texel move by it. It is what the reader does with ReadOptions::resample.
EnvironmentMap resampled_to_lat_long(EnvironmentMap map);

}  // namespace lightproof
