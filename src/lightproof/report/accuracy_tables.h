// Charts of speed against accuracy as JSON and as CSV (RFC 4180).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lightproof/results/accuracy_chart.h"

namespace lightproof {

/// A list of charts, with a list of lines each, with a list of points each.
nlohmann::ordered_json accuracy_json(const std::vector<AccuracyChart>& charts);
/// One row for each chart, estimator and number of samples.
std::string accuracy_csv(const std::vector<AccuracyChart>& charts);

}  // namespace lightproof
