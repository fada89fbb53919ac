// The levels of one product, computed.
#pragma once

#include <span>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/precompute/request.h"

namespace lightproof {

/// Levels that are computed together, because they share what takes long: a part of the work that
/// is kept or lost as a whole.
std::vector<std::vector<LevelPlan>> work_units(const PrecomputeRequest& request);

/// One level a plan, all of one product. The same bits for any number of threads.
std::vector<MapLevel> make_levels(const EnvironmentMap& map, const PrecomputeRequest& request,
                                  std::span<const LevelPlan> plans);

/// World directions of all texels of a level: face by face, row by row from the top.
std::vector<Direction> texel_directions(Projection projection, Extent extent);

}  // namespace lightproof
