#include "lightproof/report/recommendation_json.h"

#include <nlohmann/json.hpp>

#include "lightproof/report/json_number.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using json_parts::number;

/// Of this document. Grows when a key changes its meaning or goes away.
constexpr int kFormatVersion = 1;

Json json_of(const RecommendedMethod& method) {
  const bool has_table = method.table.width > 0;
  return {{"choice", method.estimator},
          {"samples", method.samples},
          {"predicted_error", number(method.predicted_error)},
          {"predicted_error_is_bound", method.is_upper_bound},
          {"measured_error", number(method.measured_error)},
          {"measured_error_error", number(method.measured_error_error)},
          {"table",
           {{"bytes", method.bytes},
            {"size", has_table ? json_parts::size(method.table) : Json(nullptr)}}},
          {"time_ms", number(method.milliseconds)},
          {"set_up_ms", number(method.set_up_milliseconds)}};
}

Json json_of(const Recommendation& recommendation) {
  Json unreached = Json::array();
  for (const UnreachedFamily& family : recommendation.unreached) {
    unreached.push_back({{"family", family.family}, {"reason", family.reason}});
  }
  Json answer = {{"map", recommendation.map},
                 {"receiver", recommendation.receiver},
                 {"material", recommendation.material},
                 {"error", number(recommendation.error)},
                 {"shading_points", recommendation.shading_points}};
  answer.update(json_of(recommendation.choice));
  answer["runner_up"] =
      recommendation.runner_up ? json_of(*recommendation.runner_up) : Json(nullptr);
  answer["reason"] = recommendation.reason;
  answer["warning"] = recommendation.warning.empty() ? Json(nullptr) : Json(recommendation.warning);
  answer["unreached"] = unreached;
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

std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run) {
  Json document = {
      {"format_version", kFormatVersion}, {"version", run.version}, {"command", run.command}};
  document.update(json_of(recommendation));
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
