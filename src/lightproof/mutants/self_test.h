// Everything that shows whether the gate can be trusted, at once.
#pragma once

#include "lightproof/core/progress.h"
#include "lightproof/suite/results.h"

namespace lightproof {

/// Mutants, calibration and power, as the report shows them: about a minute on two cores.
SelfTestResult run_self_test(std::uint64_t seed, const Progress& progress = {});

}  // namespace lightproof
