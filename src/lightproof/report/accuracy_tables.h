// Charts of speed against accuracy as JSON and as CSV (RFC 4180).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lightproof/results/accuracy_chart.h"
#include "lightproof/results/method_regime.h"

namespace lightproof {

/// A list of charts, with a list of lines each, with a list of points each.
nlohmann::ordered_json accuracy_json(const std::vector<AccuracyChart>& charts);
/// One row for each chart, estimator and number of samples.
std::string accuracy_csv(const std::vector<AccuracyChart>& charts);

/// The error, the origin, and a list of regimes.
nlohmann::ordered_json method_regimes_json(const MethodRegimes& regimes);
/// One row for each roughness and light.
std::string method_regimes_csv(const MethodRegimes& regimes);

}  // namespace lightproof
