// The product of the map and the material down a quadtree (Clarberg and Akenine-Möller 2008,
// "Practical Product Importance Sampling for Direct Illumination").
#pragma once

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// What the hierarchical product is made of.
struct HierarchicalProduct {
  /// The largest grid of squares at which k is taken.
  static constexpr Extent kMostSquares = {64, 32};
  /// The share of k's mean that every square has besides its own k.
  static constexpr double kDefensiveShare = 0.05;
};

/// A descent of the map's quadtree in which quarters weigh as the product of the map's and the
/// material's averages. The material's quadtree is made for every shading point, of k at the
/// centres of at most 64 x 32 squares, plus a twentieth of k's mean; below its squares the map
/// alone decides. Throws InputError if the map is black.
PreparedSource hierarchical_product_source(const EnvironmentMap& map);

}  // namespace lightproof
