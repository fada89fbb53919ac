// How good recommendations are, as a part of the page.
#pragma once

#include <optional>
#include <string>

#include "lightproof/results/recommendation_survey.h"

namespace lightproof {

/// How often the goals are kept, on maps that were looked at while building and on others, and the
/// worst five cases; empty without a survey.
std::string survey_html(const std::optional<RecommendationSurvey>& survey);

}  // namespace lightproof
