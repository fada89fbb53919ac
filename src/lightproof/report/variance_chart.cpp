// Variance against its prediction.
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

Json variance_rows(const std::vector<ConvergenceRecord>& records) {
  Json rows = Json::array();
  for (const ConvergenceRecord& r : records) {
    if (!has_ratio(r)) continue;
    const double ratio = r.measured_variance / r.predicted_variance;
    const double half = kBarHalfLength * r.variance_ratio_error;
    rows.push_back({{"series", r.estimator},
                    {"map", r.map},
                    {"scene", scene_name(r)},
                    {"counts", has_telling_ratio(r)},
                    {"predicted", rounded(r.predicted_variance)},
                    {"ratio", rounded(ratio)},
                    {"low", rounded(ratio - half)},
                    {"high", rounded(ratio + half)}});
  }
  return rows;
}

Json variance_tooltip() {
  return {tooltip("series", "estimator", ""),
          tooltip("map", "map", ""),
          tooltip("scene", "receiver, material", ""),
          tooltip("predicted", "predicted variance / mean\u00b2", ".3~g"),
          tooltip("ratio", "measured / predicted", ".4~g"),
          tooltip("low", "minus 2 SE", ".4~g"),
          tooltip("high", "plus 2 SE", ".4~g")};
}

Json variance_axis(const std::vector<ConvergenceRecord>& records) {
  LogRange range;
  for (const ConvergenceRecord& r : records) {
    if (has_ratio(r)) range.add(r.predicted_variance);
  }
  Json x = quantity("predicted", "predicted variance per sample / mean\u00b2 (log)", "log");
  x["axis"] = log_axis(range.low, range.high);
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 12;
  return x;
}

Json unit_rule() {
  return {{"mark", {{"type", "rule"}, {"color", "#1d232a"}, {"strokeWidth", 1}}},
          {"data", {{"values", {{{"one", 1.0}}}}}},
          {"encoding", {{"y", {{"field", "one"}, {"type", "quantitative"}}}}}};
}

/// The axis starts at 0: an error bar that reaches below says no more than that.
Json ratio_axis(const std::string& field) {
  Json y = quantity(field, "measured / predicted variance", "linear");
  y["scale"]["domainMin"] = 0;
  return y;
}

Json pale_unless_counted(double counted, double pale) {
  return {{"condition", {{"test", "datum.counts"}, {"value", counted}}}, {"value", pale}};
}

}  // namespace

std::string variance_chart(const std::vector<ConvergenceRecord>& records) {
  const std::vector<SeriesStyle> styles = estimator_styles(records);
  const Json legend = {{"title", nullptr}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json dots = points(ratio_axis("ratio"), colour, series(styles, &SeriesStyle::shape, legend));
  dots["encoding"]["tooltip"] = variance_tooltip();
  Json bars = error_bars(ratio_axis("low"), colour);
  bars["mark"].erase("opacity");
  bars["encoding"]["opacity"] = pale_unless_counted(0.6, 0.08);
  dots["mark"].erase("opacity");
  dots["encoding"]["opacity"] = pale_unless_counted(0.9, 0.14);
  Json chart = base_chart(360);
  chart["data"] = {{"values", variance_rows(records)}};
  chart["layer"] = {unit_rule(), bars, dots};
  for (std::size_t layer : {1U, 2U})
    chart["layer"][layer]["encoding"]["x"] = variance_axis(records);
  return text_of(chart);
}

}  // namespace lightproof
