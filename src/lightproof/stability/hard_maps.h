// Small maps on which methods are tried, each with one thing that is hard about it.
#pragma once

#include <cstdint>

#include "lightproof/image/environment_map.h"

namespace lightproof::hard_maps {

/// One radiance everywhere.
EnvironmentMap constant(Extent extent, float radiance = 1.0F);
/// Black but for one texel.
EnvironmentMap one_texel(Extent extent, int x, int y, float radiance = 1.0F);
/// Radiance exp(sigma times a normal number), independent from texel to texel.
EnvironmentMap lognormal(Extent extent, double sigma, std::uint64_t seed);
/// A different grey in each quarter: brighter upwards and to the right, so that no turn and no
/// mirror image of it is the map itself. Between 1 and 2.
EnvironmentMap orientation(Extent extent);
/// Thirds of pure red, green and blue side by side.
EnvironmentMap pure_colours(Extent extent);
/// The map with every radiance multiplied.
EnvironmentMap scaled(EnvironmentMap map, float factor);
/// The map turned around its axis by so many columns to the right.
EnvironmentMap turned(const EnvironmentMap& map, int columns);

}  // namespace lightproof::hard_maps
