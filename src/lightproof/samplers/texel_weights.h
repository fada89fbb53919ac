// What a texel is to be drawn in proportion to.
#pragma once

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// Grey value of every texel; under B times its solid angle. Throws InputError if the
/// map is black.
Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target);

/// The error of a map without light.
[[noreturn]] void refuse_black(const EnvironmentMap& map);

}  // namespace lightproof
