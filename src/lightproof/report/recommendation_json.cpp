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

}  // namespace

std::string recommendation_json(const Recommendation& recommendation, const RunDescription& run) {
  Json unreached = Json::array();
  for (const UnreachedFamily& family : recommendation.unreached) {
    unreached.push_back({{"family", family.family}, {"reason", family.reason}});
  }
  Json document = {{"format_version", kFormatVersion},
                   {"version", run.version},
                   {"command", run.command},
                   {"map", recommendation.map},
                   {"receiver", recommendation.receiver},
                   {"material", recommendation.material},
                   {"error", number(recommendation.error)},
                   {"shading_points", recommendation.shading_points}};
  document.update(json_of(recommendation.choice));
  document["runner_up"] =
      recommendation.runner_up ? json_of(*recommendation.runner_up) : Json(nullptr);
  document["reason"] = recommendation.reason;
  document["warning"] =
      recommendation.warning.empty() ? Json(nullptr) : Json(recommendation.warning);
  document["unreached"] = unreached;
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
