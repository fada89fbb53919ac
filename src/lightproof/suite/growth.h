// How costs grow with the map: the time of a sample and of one of its steps, and that of building.
#pragma once

#include <span>
#include <vector>

#include "lightproof/suite/results.h"

namespace lightproof {

/// Of each sampler that was measured on three maps or more, in the order of the registry. Knees are
/// called at 1 % a sampler: of one whose time of a step follows a power law with normal scatter,
/// that often (see stats/knee.h).
std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records,
                                 const CacheSizes& caches);

}  // namespace lightproof
