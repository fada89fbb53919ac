// One value a run.
#pragma once

#include <optional>
#include <string>

#include "lightproof/history/run.h"

namespace lightproof {

/// The median over the repetitions of a benchmark in a run; none if it has none.
std::optional<double> run_value(const BenchmarkRun& run, Metric metric,
                                const std::string& benchmark);

}  // namespace lightproof
