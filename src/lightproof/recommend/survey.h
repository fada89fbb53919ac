// How good are recommendations? Held against every method, measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/accuracy/method_costs.h"
#include "lightproof/recommend/recommend.h"
#include "lightproof/results/recommendation_survey.h"

namespace lightproof {

/// How a survey is made.
struct SurveyOptions {
  const ReceiverInfo* receiver;
  std::vector<double> errors = {0.2, 0.05, 0.01};
  AccuracyQuality quality = accuracy_qualities()[1];
  bool verify = true;  ///< whether recommendations may run what they recommend
  std::uint64_t seed = 1;
};

/// The cases of a map and a material, one an error. Chart, recommendation and judgement have random
/// numbers of their own.
std::vector<SurveyCase> survey(const EnvironmentMap& map, const NamedMaterial& material,
                               const SurveyOptions& options, const MethodCosts& costs);

/// The materials of a survey: lambert, phong and ggx with ten parameters in all.
std::span<const char* const> survey_materials();

/// Keeps a survey in the folder, in the place of what was there, for reports to show. Returns
/// whether it could.
bool keep_survey(const std::filesystem::path& folder, const RecommendationSurvey& survey);
/// What is kept in the folder; none if nothing is.
std::optional<RecommendationSurvey> kept_survey(const std::filesystem::path& folder);

}  // namespace lightproof
