#include "lightproof/report/recommendation_json.h"

#include <nlohmann/json.hpp>

#include "lightproof/report/json_number.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using json_parts::number;

/// Of this document. Grows when a key changes its meaning or goes away.
constexpr int kFormatVersion = 2;

Json json_of(const MethodTime& time) {
  return {{"point_ms", number(time.point)}, {"set_up_ms", number(time.set_up)}};
}

Json json_of(const RecommendedMethod& method) {
  const bool has_table = method.table.width > 0;
  return {{"choice", method.estimator},
          {"samples", method.samples},
          {"predicted_error", number(method.predicted_error)},
          {"predicted_error_is_bound", method.is_upper_bound},
          {"measured_error", number(method.measured_error)},
          {"measured_error_standard_error", number(method.measured_error_error)},
          {"table",
           {{"bytes", method.bytes},
            {"size", has_table ? json_parts::size(method.table) : Json(nullptr)}}},
          {"time_ms", number(method.known_time().point)},
          {"set_up_ms", number(method.known_time().set_up)},
          {"predicted_time", json_of(method.predicted_time)},
          {"measured_time", json_of(method.measured_time)}};
}

Json json_of(const std::vector<UnreachedFamily>& unreached) {
  Json list = Json::array();
  for (const UnreachedFamily& family : unreached) {
    list.push_back({{"family", to_string(family.family)}, {"reason", family.reason}});
  }
  return list;
}

Json json_of(const std::vector<UnpredictedMethod>& unpredicted) {
  Json list = Json::array();
  for (const UnpredictedMethod& method : unpredicted) {
    list.push_back({{"estimator", method.estimator}, {"reason", method.reason}});
  }
  return list;
}

Json json_of(const RecommendationQuestion& question) {
  return {{"map", question.map},
          {"receiver", question.receiver},
          {"material", question.material},
          {"error", number(question.error)},
          {"shading_points", question.shading_points}};
}

Json json_of(const std::optional<SurveyedChoice>& choice) {
  if (!choice) return nullptr;
  return {{"estimator", choice->estimator},
          {"samples", choice->samples},
          {"predicted_error", number(choice->predicted_error)},
          {"verified_error", number(choice->verified_error)},
          {"error", number(choice->error)},
          {"time_ms", number(1e3 * choice->seconds)}};
}

Json json_of(const SurveyCase& one) {
  const bool has_best = !one.best.empty();
  return {{"map", one.map},
          {"material", one.material},
          {"error", number(one.error)},
          {"was_tuned_on", one.was_tuned_on},
          {"choice", json_of(one.choice)},
          {"best", has_best ? Json(one.best) : Json(nullptr)},
          {"best_time_ms", has_best ? number(1e3 * one.best_seconds) : Json(nullptr)},
          {"error_is_kept", one.error_is_kept()},
          {"time_is_kept", one.time_is_kept()}};
}

Json json_of(const Recommendation& recommendation) {
  Json answer = json_of(recommendation.question);
  answer.update(json_of(recommendation.choice));
  answer["runner_up"] =
      recommendation.runner_up ? json_of(*recommendation.runner_up) : Json(nullptr);
  answer["reason"] = recommendation.reason;
  answer["warning"] = recommendation.warning.empty() ? Json(nullptr) : Json(recommendation.warning);
  answer["unreached"] = json_of(recommendation.unreached);
  answer["unpredicted"] = json_of(recommendation.unpredicted);
  return answer;
}

}  // namespace

Json recommendations_json(const std::vector<Recommendation>& recommendations) {
  Json list = Json::array();
  for (const Recommendation& recommendation : recommendations) {
    list.push_back(json_of(recommendation));
  }
  return list;
}

Json refused_recommendations_json(const std::vector<RefusedRecommendation>& refused) {
  Json list = Json::array();
  for (const RefusedRecommendation& one : refused) {
    list.push_back(json_of(one.question));
    list.back()["unreached"] = json_of(one.unreached);
  }
  return list;
}

Json recommendation_survey_json(const std::optional<RecommendationSurvey>& survey) {
  if (!survey) return nullptr;
  Json groups = Json::array();
  for (const bool was_tuned_on : {true, false}) {
    const SurveyShares shares = shares_of(cases_of(*survey, was_tuned_on));
    groups.push_back({{"was_tuned_on", was_tuned_on},
                      {"answered", shares.answered},
                      {"errors_kept", number(shares.errors_kept)},
                      {"times_kept", number(shares.times_kept)},
                      {"wrongly_refused", shares.wrongly_refused},
                      {"rightly_refused", shares.rightly_refused}});
  }
  Json cases = Json::array();
  for (const SurveyCase& one : survey->cases) cases.push_back(json_of(one));
  return {{"origin", survey->origin},
          {"receiver", survey->receiver},
          {"quality", survey->quality},
          {"groups", groups},
          {"cases", cases}};
}

std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run) {
  Json document = {
      {"format_version", kFormatVersion}, {"version", run.version}, {"command", run.command}};
  document.update(json_of(recommendation));
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
