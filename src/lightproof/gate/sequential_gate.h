// The gate that stops as soon as it knows: for samplers whose samples are expensive.
#pragma once

#include <span>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/gate/gate.h"

namespace lightproof {

/// Runs the gate sequentially: draws until the counts are beyond doubt, and `options.samples` at
/// the most; an instance that lasts so long is accepted. The evidence is the average of the
/// e-processes (stats/sequential.h) of the bins, the rows, the columns and, where they are not too
/// many, the texels; looked at whenever the samples have grown by half. An instance is rejected
/// when it reaches instances/family_alpha: over the whole run a correct sampler is rejected with at
/// most family_alpha, whenever one stops. One record an instance, of the samples that it took, and
/// the exact checks; means and variances are not tested.
/// The number of threads, or of processes, changes no bit: processes share the instances and all
/// get the whole result. Throws std::logic_error as run_gate() does.
GateResult run_sequential_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                               const Progress& progress = {},
                               const Communicator& communicator = {});

}  // namespace lightproof
