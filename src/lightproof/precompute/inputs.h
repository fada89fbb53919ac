// What the levels of a precomputation depend on.
#pragma once

#include <vector>

#include "lightproof/core/unfinished_work.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/precompute/request.h"

namespace lightproof {

/// All that decides the levels that are made of a map, named as on the command line: the same
/// inputs mean the same levels, to the last bit. Formats of files, checks and the BRDF map, which
/// is made of no map, are none of them.
std::vector<RunInput> inputs_of(const EnvironmentMap& map, const PrecomputeRequest& request);

}  // namespace lightproof
