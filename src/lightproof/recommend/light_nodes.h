// The nodes at which one shading point's light is integrated: the cells of a map's summary, and
// texels or parts of texels where the material's lobe is narrower than its blocks.
#pragma once

#include <array>
#include <vector>

#include "lightproof/materials/lobe_extent.h"
#include "lightproof/materials/material_batch.h"
#include "lightproof/recommend/map_summary.h"

namespace lightproof {

/// Where a material's k varies fast.
struct LobeReach {
  LobeExtent extent;
  double margin;  ///< an angle around its axis, in radians, at which other lobes may stand
};

/// The lobe of a material at a shading point.
LobeReach lobe_of(const Material& material, const ShadingPoint& at);

/// Nodes, each number in an array of its own.
struct LightNodes {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  std::vector<double> solid_angle;
  std::vector<double> light;   ///< ∫ L
  std::vector<double> square;  ///< ∫ L^2
  std::array<std::vector<double>, kTableDensities> second;
  std::vector<std::uint16_t> product;
  std::vector<std::uint16_t> quadrant;

  std::size_t size() const { return light.size(); }
  Direction direction(std::size_t i) const { return {x[i], y[i], z[i]}; }
  DirectionArrays directions() const { return {x, y, z}; }
};

/// All nodes of a map in blocks that reach above the horizon of this normal, or of `also` if that
/// is not 0. A node is at most a fifth as large as the lobe is wide, or as it is far from the
/// lobe's axis; as nothing more than the summary's finest grid is known, light is even inside of
/// its texels.
LightNodes nodes_for(const MapSummary& summary, const LobeReach& lobe, Direction normal,
                     Direction also = {0.0, 0.0, 0.0});

}  // namespace lightproof
