// How costs grow with the map: the time of a sample and of one of its steps, and that of building.
#pragma once

#include <span>
#include <vector>

#include "lightproof/results/growth_fit.h"
#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// How the costs of each sampler grow that was measured on three maps or more, in the order of the
/// registry. If the
/// time of a step follows one power law with normal scatter for all of them, any sampler gets
/// breakpoints with a probability of at most 1 % (see stats/segmented_regression.h).
std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records,
                                 const CacheSizes& caches);

}  // namespace lightproof
