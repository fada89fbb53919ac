// Which test kills which mutant, and with how many samples.
#pragma once

#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/suite/results.h"

namespace lightproof {

/// A map on which every mutant shows: 128 x 64, dim, so that the lower quarter falls below an
/// absolute threshold; brighter upwards and on one side; warm on one side; a sun that does not
/// outshine the rest; the first row black.
EnvironmentMap hostile_map();

/// Every mutant of samplers under weighting B on hostile_map(), and every mutant of warps, judged
/// by the gate with 2^12, 2^14, … samples up to 2^18, and up to 2^22 if the oracle that it names
/// has not rejected it before; and by the sequential gate.
std::vector<KillRecord> measure_kills(std::uint64_t seed, const Progress& progress = {});

}  // namespace lightproof
