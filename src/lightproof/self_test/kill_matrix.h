// Which test kills which mutant, and with how many samples.
#pragma once

#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// Has every mutant of samplers under density B on mutant_map(), and every mutant of warps, judged
/// by the gate with 2^12, 2^14, … samples up to 2^18, and up to 2^22 if the oracle that it names
/// has not rejected it before; and by the sequential gate.
std::vector<KillRecord> measure_kills(std::uint64_t seed, const Progress& progress = {});

}  // namespace lightproof
