// What a material makes of a map's light at a shading point, node by node.
#pragma once

#include <vector>

#include "lightproof/recommend/light_nodes.h"

namespace lightproof {

/// A point's nodes, and what the material does there.
struct ScatteredLight {
  LightNodes nodes;
  std::vector<double> k;    ///< f_r (n·l)+
  std::vector<double> pdf;  ///< of the material's lobes
  double mean = 0.0;        ///< I = ∫ L k
  /// ∫ of the material's density, which is 1 but for the error of the nodes. With it in the place
  /// of 1, that error stays out of the variance where L k over the density is even.
  double lobes = 0.0;
};

/// The nodes above the horizon of the point's normal, or of `also` if that is not 0.
ScatteredLight scattered(const MapSummary& summary, const Material& material,
                         const ShadingPoint& at, const LobeReach& lobe,
                         Direction also = {0.0, 0.0, 0.0});

}  // namespace lightproof
