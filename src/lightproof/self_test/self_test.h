// Everything that shows whether the gate can be trusted, at once.
#pragma once

#include <cstdint>
#include <span>

#include "lightproof/core/progress.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// Measures what mutants, calibration and power come to, and the names that the gate gives to
/// mutants on these maps, as the report shows them. Every map adds a run of the gate on all
/// mutants.
SelfTestResult run_self_test(std::span<const MapRecord> maps, std::uint64_t seed,
                             const Progress& progress = {});

}  // namespace lightproof
