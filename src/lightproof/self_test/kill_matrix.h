// Which test kills which mutant, and with how many samples.
#pragma once

#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// Every mutant of samplers under density B on mutant_map(), and every mutant of warps, judged
/// by the gate with 2^12, 2^14, … samples up to 2^18, and up to 2^22 if the oracle that it names
/// has not rejected it before; and by the sequential gate. The same bits for any number of
/// processes, which share the mutants and all get the whole result.
std::vector<KillRecord> measure_kills(std::uint64_t seed, const Progress& progress = {},
                                      const Communicator& communicator = {});

}  // namespace lightproof
