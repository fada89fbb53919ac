// The product of the map and the material on few blocks, then the map alone inside a block (Conty
// Estevez and Lecocq 2018, "Fast Product Importance Sampling of Environment Maps").
#pragma once

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// What the two-level product is made of.
struct TwoLevelProduct {
  /// Blocks along either side of the map; fewer of a map with fewer texels. Block i begins at texel
  /// i texels / blocks, rounded down.
  static constexpr int kMostBlocks = 12;
  /// Directions at which k is taken, along either side of a block.
  static constexpr int kNodes = 2;
  /// The share of k's mean that every block has besides its own k.
  static constexpr double kDefensiveShare = 0.05;
};

/// Blocks of the map, 12 x 12, in proportion to their light times the mean of k over 2 x 2
/// directions, plus a twentieth of k's mean, which lobes that fall between these directions need;
/// then a texel of the block in proportion to its light. Throws InputError if the map is black.
PreparedSource two_level_product_source(const EnvironmentMap& map);

}  // namespace lightproof
