// Pictures of what a monotone table and an alias table make of a regular grid.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/warp_grid.h"

namespace lightproof {

/// Two pictures side by side for each map, all but the first map folded; empty without grids.
std::string warp_figures(const std::vector<WarpGrid>& grids);

/// How much farther apart an alias table takes neighbours than the monotone one. `grids` is not
/// empty.
std::string warp_finding(const std::vector<WarpGrid>& grids);

}  // namespace lightproof
