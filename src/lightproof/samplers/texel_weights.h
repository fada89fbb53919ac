// What a texel is to be drawn in proportion to.
#pragma once

#include <span>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// Grey value of every texel; under B times its solid angle. Throws InputError if the
/// map is black.
Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target);

/// Those of the texels of one row, map.radiance's width of them.
void weigh_row(const EnvironmentMap& map, TargetDensity target, int y, std::span<double> weights);

/// The error of a map without light.
[[noreturn]] void refuse_black(const EnvironmentMap& map);

}  // namespace lightproof
