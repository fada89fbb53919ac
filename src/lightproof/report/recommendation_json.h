// A recommendation as JSON.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/run_description.h"
#include "lightproof/results/recommendation.h"

namespace lightproof {

/// docs/schema/recommendation.schema.json describes it.
std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run);

}  // namespace lightproof
