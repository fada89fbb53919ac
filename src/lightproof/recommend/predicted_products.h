// The densities of estimators that draw blocks of the map by the product with the material, found
// as they find them.
#pragma once

#include <vector>

#include "lightproof/estimators/texel_directions.h"
#include "lightproof/materials/material.h"
#include "lightproof/recommend/map_summary.h"

namespace lightproof {

/// The products of one map, whose summary must outlive it, and one material.
class PredictedProducts {
 public:
  PredictedProducts(const MapSummary& summary, const Material& material);

  /// Luminance over the density of "product two-level" in each of its blocks (MapSummary::
  /// product_light), in luminance times steradian.
  std::vector<double> two_level_scales(const ShadingPoint& at) const;
  /// Luminance over the density of "product hierarchical" in each of the squares of the quadtree's
  /// last level, in luminance times steradian; 0 where it draws nothing.
  std::vector<double> quadrant_scales(const ShadingPoint& at) const;

 private:
  const MapSummary* summary_;
  Material material_;
  TexelDirections nodes_;
  TexelDirections quadrant_centres_;
};

}  // namespace lightproof
