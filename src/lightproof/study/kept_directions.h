// The first stage of the gate for warps and materials, kept: it depends on no map.
#pragma once

#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/gate/gate.h"

namespace lightproof {

/// screen_runs() of all samplers of directions: what the cache holds of this program, this machine
/// and this number of samples and seed, or what is found now, which is kept.
KeptMeasurement<ScreenedRuns> kept_directions(const GateOptions& options,
                                              const MeasurementCache& cache,
                                              const Progress& progress = {},
                                              const Communicator& communicator = {});

}  // namespace lightproof
