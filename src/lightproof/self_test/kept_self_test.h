// The self-test, kept: most of it depends on the program, its options and the machine alone, the
// names of mutants on the map as well, and none of it changes until one of these does.
#pragma once

#include <span>

#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/self_test/self_test.h"

namespace lightproof {

/// What run_self_test() measures, with its origin: what the cache holds of this program, to the
/// last byte, on this machine, with this compiler and commit, these options and (for the names of
/// mutants) a map of this name and content; the rest is measured, and kept. Damaged files are
/// replaced.
SelfTestResult kept_self_test(std::span<const MapRecord> maps, const SelfTestOptions& options,
                              const MeasurementCache& cache, const Progress& progress = {});

}  // namespace lightproof
