// Charts of the gate's test of itself, as Vega-Lite specifications (see charts.h).
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// A chart of tests against mutants, coloured by the fewest samples with which it rejects.
std::string kill_chart(const std::vector<KillRecord>& mutants);

/// A chart of the share of p-values below p, less p, against p, one line a test, between the limits
/// that uniform ones stay inside with all but 1e-6.
std::string calibration_chart(const std::vector<CalibrationRecord>& tests);

/// The deviation that the largest of `replicates` uniform p-values' distribution exceeds with a
/// probability of 1e-6 (Massart 1990).
double calibration_limit(std::uint64_t replicates);

/// A chart of the share of rejections against samples: predicted as lines, measured as points.
std::string power_chart(const std::vector<PowerRecord>& power);

}  // namespace lightproof
