// Variance against its prediction, and the time per sample against the size of the map.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lightproof/report/chart_parts.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/numbers.h"

namespace lightproof {
namespace {

Json variance_rows(const std::vector<ConvergenceRecord>& records) {
  Json rows = Json::array();
  for (const ConvergenceRecord& r : records) {
    if (!has_ratio(r)) continue;
    const double ratio = r.measured_variance / r.predicted_variance;
    const double half = kBarHalfLength * r.variance_ratio_error;
    rows.push_back({{"series", r.strategy},
                    {"map", r.map},
                    {"scene", scene_name(r)},
                    {"predicted", rounded(r.predicted_variance)},
                    {"ratio", rounded(ratio)},
                    {"low", rounded(ratio - half)},
                    {"high", rounded(ratio + half)}});
  }
  return rows;
}

Json variance_tooltip() {
  return {tooltip("series", "strategy", ""),
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

Json error_bars(const Json& y, const Json& colour) {
  return {{"mark", {{"type", "rule"}, {"strokeWidth", 1.5}, {"opacity", 0.6}, {"clip", true}}},
          {"encoding", {{"y", y}, {"y2", {{"field", "high"}}}, {"color", colour}}}};
}

Json points(const Json& y, const Json& colour, const Json& shape) {
  return {{"mark", {{"type", "point"}, {"filled", true}, {"size", 55}, {"opacity", 0.9}}},
          {"encoding", {{"y", y}, {"color", colour}, {"shape", shape}}}};
}

/// "linear_scan, S + T steps", or the name alone without a fit.
std::string label_of(const std::string& sampler, const std::vector<GrowthFit>& growth) {
  const auto fit = std::find_if(growth.begin(), growth.end(),
                                [&](const GrowthFit& g) { return g.sampler == sampler; });
  if (fit == growth.end()) return sampler;
  return fmt::format("{}, {} step{}", sampler, fit->model, fit->model == "1" ? "" : "s");
}

int predictor(Extent extent) { return extent.width + extent.height; }

Json size_axis(const std::vector<ThroughputRecord>& records) {
  std::map<int, std::string> sizes;
  for (const ThroughputRecord& r : records) {
    sizes.emplace(predictor(r.extent), extent_text(r.extent));
  }
  Json values = Json::array();
  std::string label = "''";
  for (const auto& [size, text] : sizes) {
    values.push_back(size);
    label = fmt::format("datum.value == {} ? '{}' : {}", size, text, label);
  }
  Json x = quantity("size", "map size, by width S + height T (log)", "log");
  x["axis"] = {{"values", values}, {"labelExpr", label}};
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 36;
  return x;
}

Json throughput_rows(const std::vector<ThroughputRecord>& records,
                     const std::vector<GrowthFit>& growth) {
  Json rows = Json::array();
  for (const ThroughputRecord& r : records) {
    if (!drawable(r.ns_per_sample)) continue;
    rows.push_back({{"series", label_of(r.sampler, growth)},
                    {"map", r.map},
                    {"extent", extent_text(r.extent)},
                    {"size", predictor(r.extent)},
                    {"ns", rounded(r.ns_per_sample)},
                    {"low", drawable(r.ns_low) ? r.ns_low : r.ns_per_sample},
                    {"high", drawable(r.ns_high) ? r.ns_high : r.ns_per_sample}});
  }
  return rows;
}

Json time_axis(const std::string& field, LogRange range) {
  Json y = quantity(field, "time per sample (ns, log)", "log");
  y["axis"] = log_axis(range.low, range.high);
  return y;
}

Json throughput_tooltip() {
  return {tooltip("series", "sampler", ""),      tooltip("map", "map", ""),
          tooltip("extent", "map size", ""),     tooltip("ns", "median, ns", ".3~g"),
          tooltip("low", "fastest, ns", ".3~g"), tooltip("high", "slowest, ns", ".3~g")};
}

/// From 0: an error bar that reaches below says no more than that.
Json ratio_axis(const std::string& field) {
  Json y = quantity(field, "measured / predicted variance", "linear");
  y["scale"]["domainMin"] = 0;
  return y;
}

}  // namespace

std::string variance_chart(const std::vector<ConvergenceRecord>& records) {
  const std::vector<SeriesStyle> styles = strategy_styles(records);
  const Json legend = {{"title", nullptr}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json dots = points(ratio_axis("ratio"), colour, series(styles, &SeriesStyle::shape, legend));
  dots["encoding"]["tooltip"] = variance_tooltip();
  Json chart = base_chart(360);
  chart["data"] = {{"values", variance_rows(records)}};
  chart["layer"] = {unit_rule(), error_bars(ratio_axis("low"), colour), dots};
  for (std::size_t layer : {1U, 2U})
    chart["layer"][layer]["encoding"]["x"] = variance_axis(records);
  return text_of(chart);
}

std::string throughput_chart(const std::vector<ThroughputRecord>& records,
                             const std::vector<GrowthFit>& growth) {
  std::vector<std::string> names;
  LogRange range;
  for (const ThroughputRecord& r : records) {
    names.push_back(label_of(r.sampler, growth));
    range.add(r.ns_per_sample);
  }
  const std::vector<SeriesStyle> styles = series_styles(names);
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json dots = points(time_axis("ns", range), colour, series(styles, &SeriesStyle::shape, legend));
  dots["encoding"]["tooltip"] = throughput_tooltip();
  const Json lines = {
      {"mark", {{"type", "line"}, {"strokeWidth", 2}}},
      {"encoding",
       {{"y", time_axis("ns", range)}, {"color", colour}, {"detail", {{"field", "map"}}}}}};
  Json chart = base_chart(380);
  chart["data"] = {{"values", throughput_rows(records, growth)}};
  chart["encoding"] = {{"x", size_axis(records)}};
  chart["layer"] = {lines, error_bars(time_axis("low", range), colour), dots};
  return text_of(chart);
}

}  // namespace lightproof
