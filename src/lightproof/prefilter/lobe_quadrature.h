// Quadrature over the hemisphere of a lobe, for integrands that depend on the angle to its axis.
#pragma once

#include <vector>

#include "lightproof/prefilter/lobe.h"

namespace lightproof {

/// Angles to the lobe's axis in radians, their cosines, and weights: the solid angle of the ring
/// that a node stands for times the lobe's relative density.
struct LobeNodes {
  std::vector<double> angles;
  std::vector<double> cosines;
  std::vector<double> weights;
};

/// Nodes that integrate the lobe times P_l of the cosine, l = 0 … degree, to rounding.
LobeNodes lobe_nodes(const Lobe& lobe, int degree);

}  // namespace lightproof
