// A recommendation as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/run_description.h"
#include "lightproof/results/recommendation.h"
#include "lightproof/results/recommendation_survey.h"

namespace lightproof {

/// Recommendations as JSON, without the command and the machine that made them.
nlohmann::ordered_json recommendations_json(const std::vector<Recommendation>& recommendations);

/// Questions that no method answers, as JSON, with what stops each family.
nlohmann::ordered_json refused_recommendations_json(
    const std::vector<RefusedRecommendation>& refused);
/// The survey of how good recommendations are, as JSON: maps that were looked at while building
/// first; null without a survey.
nlohmann::ordered_json recommendation_survey_json(
    const std::optional<RecommendationSurvey>& survey);

/// docs/schema/recommendation.schema.json describes it.
std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run);

}  // namespace lightproof
