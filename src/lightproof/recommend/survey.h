// How good are recommendations? Held against every method, measured.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/accuracy/method_costs.h"
#include "lightproof/recommend/recommend.h"

namespace lightproof {

/// One question, its answer, and the best answer that was found by measuring all methods.
struct SurveyCase {
  std::string map;
  std::string material;
  double error = 0.0;  ///< that was asked for
  /// Empty if the recommendation was that no method reaches the error.
  std::optional<RecommendedMethod> choice;
  /// Time of the choice at a shading point, its part of the set-up in it, as the chart measured it.
  double choice_seconds = 0.0;
  /// The method that reaches the error in the least time of all in the chart; empty if none does.
  std::string best;
  double best_seconds = 0.0;

  /// Whether the measured error is at most 1.1 times what was asked for, or none reaches it.
  bool error_is_kept() const;
  /// Whether the time is at most 1.5 times that of the best, or there is none.
  bool time_is_kept() const;
};

/// How a survey is made.
struct SurveyOptions {
  const ReceiverInfo* receiver;
  std::vector<double> errors = {0.2, 0.05, 0.01};
  AccuracyQuality quality = accuracy_qualities()[1];
  bool verify = true;  ///< whether recommendations may run what they recommend
  std::uint64_t seed = 1;
};

/// The cases of a map and a material, one an error.
std::vector<SurveyCase> survey(const EnvironmentMap& map, const NamedMaterial& material,
                               const SurveyOptions& options, const MethodCosts& costs);

/// The materials of a survey: lambert, phong and ggx with ten parameters in all.
std::span<const char* const> survey_materials();

}  // namespace lightproof
