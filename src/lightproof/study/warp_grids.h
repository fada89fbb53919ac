// A regular grid of the unit square, drawn through a monotone table and through an alias table.
#pragma once

#include <span>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/results/warp_grid.h"

namespace lightproof {

/// Two grids of 31 x 31 points for each map, by density B: by binary_search, then by alias.
std::vector<WarpGrid> study_warp_grids(std::span<const EnvironmentMap> maps);

}  // namespace lightproof
