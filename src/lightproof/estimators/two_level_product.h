// The product of the map and the material on few blocks, then the map alone inside a block (Conty
// Estevez and Lecocq 2018, "Fast Product Importance Sampling of Environment Maps").
#pragma once

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// Blocks of the map, 12 x 12, in proportion to their light times the mean of k over 2 x 2
/// directions, plus a twentieth of k's mean, which lobes that fall between these directions need;
/// then a texel of the block in proportion to its light. Throws InputError if the map is black.
PreparedSource two_level_product_source(const EnvironmentMap& map);

}  // namespace lightproof
