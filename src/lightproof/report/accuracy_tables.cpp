#include "lightproof/report/accuracy_tables.h"

#include "lightproof/report/csv_row.h"
#include "lightproof/report/json_number.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using json_parts::number;

Json json_of(const AccuracyPoint& p) {
  return {{"samples", p.samples},
          {"seconds", number(p.seconds)},
          {"rmse", number(p.rmse)},
          {"rmse_error", number(p.rmse_error)},
          {"predicted", number(p.predicted)}};
}

Json json_of(const LeftOutEstimator& r) {
  return {{"estimator", r.estimator}, {"reason", r.reason}};
}

template <class Record>
Json list_of(const std::vector<Record>& records);

Json json_of(const AccuracyLine& r) {
  return {{"estimator", r.estimator},
          {"family", to_string(r.family)},
          {"biased", r.is_biased},
          {"set_up_seconds", number(r.set_up_seconds)},
          {"set_up_processor_seconds", number(r.set_up_processor_seconds)},
          {"bytes", r.bytes},
          {"slope", number(r.slope)},
          {"slope_error", number(r.slope_error)},
          {"floor", number(r.floor)},
          {"points", list_of(r.points)}};
}

Json json_of(const AccuracyChart& r) {
  return {{"map", r.map},
          {"receiver", r.receiver},
          {"material", r.material},
          {"occluded", r.is_occluded},
          {"shading_points", r.shading_points},
          {"replicates", r.replicates},
          {"quality", r.quality},
          {"mean", number(r.mean)},
          {"estimators", list_of(r.lines)},
          {"left_out", list_of(r.left_out)}};
}

template <class Record>
Json list_of(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(json_of(record));
  return list;
}

}  // namespace

Json accuracy_json(const std::vector<AccuracyChart>& charts) { return list_of(charts); }

std::string accuracy_csv(const std::vector<AccuracyChart>& charts) {
  std::string csv =
      "map,receiver,material,quality,shading_points,estimator,family,biased,set_up_seconds,"
      "set_up_processor_seconds,bytes,slope,slope_error,floor,samples,seconds,rmse,rmse_error,"
      "predicted\n";
  for (const AccuracyChart& chart : charts) {
    for (const AccuracyLine& line : chart.lines) {
      for (const AccuracyPoint& p : line.points) {
        csv += csv_parts::row(
            chart.map, chart.receiver, chart.material, chart.quality, chart.shading_points,
            line.estimator, to_string(line.family), line.is_biased ? "yes" : "no",
            line.set_up_seconds, line.set_up_processor_seconds, line.bytes, line.slope,
            line.slope_error, line.floor, p.samples, p.seconds, p.rmse, p.rmse_error, p.predicted);
      }
    }
  }
  return csv;
}

Json method_regimes_json(const MethodRegimes& regimes) {
  Json list = Json::array();
  for (const MethodRegime& r : regimes.regimes) {
    list.push_back({{"roughness", number(r.roughness)},
                    {"effective_fraction", number(r.effective_fraction)},
                    {"estimator", r.estimator},
                    {"family", r.family ? to_string(*r.family) : ""},
                    {"seconds", number(r.seconds)},
                    {"unbiased_estimator", r.unbiased_estimator},
                    {"unbiased_seconds", number(r.unbiased_seconds)}});
  }
  return {{"error", number(regimes.error)}, {"origin", regimes.origin}, {"regimes", list}};
}

std::string method_regimes_csv(const MethodRegimes& regimes) {
  std::string csv =
      "roughness,effective_fraction,error,estimator,family,seconds,unbiased_estimator,"
      "unbiased_seconds\n";
  for (const MethodRegime& r : regimes.regimes) {
    csv += csv_parts::row(r.roughness, r.effective_fraction, regimes.error, r.estimator,
                          r.family ? to_string(*r.family) : "", r.seconds, r.unbiased_estimator,
                          r.unbiased_seconds);
  }
  return csv;
}

}  // namespace lightproof
