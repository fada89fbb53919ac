// A recommendation as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lightproof/core/run_description.h"
#include "lightproof/results/recommendation.h"

namespace lightproof {

/// The answers, without what made them.
nlohmann::ordered_json recommendations_json(const std::vector<Recommendation>& recommendations);

/// docs/schema/recommendation.schema.json describes it.
std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run);

}  // namespace lightproof
