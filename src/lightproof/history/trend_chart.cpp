#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "lightproof/history/trend_page.h"
#include "lightproof/page/chart_parts.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace {

constexpr const char* kLineColour = "#0072b2";
constexpr const char* kLevelColour = "#1a1a1a";
constexpr const char* kChangeColour = "#a31515";
/// Noise of a percent must not fill the chart.
constexpr double kLeastHalfRange = 0.1;

std::vector<double> values_of(const TrendLine& line) {
  std::vector<double> values;
  for (const TrendPoint& point : line.points) values.push_back(point.value);
  return values;
}

Json point_rows(const TrendLine& line) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const TrendPoint& point = line.points[i];
    rows.push_back({{"number", i + 1},
                    {"commit", point.commit},
                    {"value", rounded(point.value)},
                    {"runs", point.runs}});
  }
  return rows;
}

/// One row per level: from its first commit to its last.
Json level_rows(const TrendLine& line) {
  const std::vector<double> values = values_of(line);
  std::vector<std::size_t> edges = {0};
  for (const ChangePoint& change : line.changes) edges.push_back(change.first);
  edges.push_back(values.size());
  Json rows = Json::array();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(edges[i]);
    const auto to = values.begin() + static_cast<std::ptrdiff_t>(edges[i + 1]);
    rows.push_back({{"from", static_cast<double>(edges[i]) + 0.75},
                    {"to", static_cast<double>(edges[i + 1]) + 0.25},
                    {"level", rounded(median({from, to}))}});
  }
  return rows;
}

/// Rows that mark the change between the last commit before it and the first one after.
Json change_rows(const TrendLine& line) {
  Json rows = Json::array();
  for (const ChangePoint& change : line.changes) {
    rows.push_back(
        {{"at", static_cast<double>(change.first) + 0.5},
         {"commit", line.points[change.first].commit},
         {"label", fmt::format("{}{:.0f} %", change.ratio > 1.0 ? "\u25b2 +" : "\u25bc \u2212",
                               100.0 * std::abs(change.ratio - 1.0))}});
  }
  return rows;
}

Json value_axis(const TrendLine& line, const std::string& field) {
  const std::vector<double> values = values_of(line);
  const double middle = median(values);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Json y = quantity(field, to_string(line.metric), "linear");
  y["scale"]["domain"] = {rounded(std::min(*low, (1.0 - kLeastHalfRange) * middle)),
                          rounded(std::max(*high, (1.0 + kLeastHalfRange) * middle))};
  y["axis"] = {{"tickCount", 4}, {"format", ",.4~r"}};
  return y;
}

Json place_axis(const TrendLine& line, const std::string& field) {
  Json x = quantity(field, "commit, oldest first", "linear");
  x["scale"]["domain"] = {0.5, static_cast<double>(line.points.size()) + 0.5};
  x["scale"]["nice"] = false;
  x["axis"] = {{"tickMinStep", 1}, {"tickCount", 5}, {"format", "d"}, {"grid", false}};
  return x;
}

Json measured_layer(const TrendLine& line, const char* mark) {
  Json layer = {{"mark", {{"type", mark}, {"color", kLineColour}, {"filled", true}}}};
  layer["data"] = {{"values", point_rows(line)}};
  layer["encoding"] = {
      {"x", place_axis(line, "number")},
      {"y", value_axis(line, "value")},
      {"tooltip",
       {tooltip("commit", "commit", ""), tooltip("number", "number", "d"),
        tooltip("value", to_string(line.metric), ".4~g"), tooltip("runs", "runs", "d")}}};
  if (std::string_view(mark) == "line") {
    layer["mark"] = {
        {"type", "line"}, {"color", kLineColour}, {"strokeWidth", 1}, {"opacity", 0.5}};
  }
  return layer;
}

Json level_layer(const TrendLine& line) {
  Json layer = {{"mark", {{"type", "rule"}, {"color", kLevelColour}, {"strokeWidth", 1.5}}}};
  layer["data"] = {{"values", level_rows(line)}};
  layer["encoding"] = {
      {"x", place_axis(line, "from")}, {"x2", {{"field", "to"}}}, {"y", value_axis(line, "level")}};
  return layer;
}

Json change_layers(const TrendLine& line) {
  const Json data = {{"values", change_rows(line)}};
  const Json x = place_axis(line, "at");
  const Json rule = {
      {"mark",
       {{"type", "rule"}, {"color", kChangeColour}, {"strokeDash", {4, 3}}, {"strokeWidth", 1.5}}},
      {"data", data},
      {"encoding", {{"x", x}, {"tooltip", {tooltip("commit", "since", "")}}}}};
  const Json label = {{"mark",
                       {{"type", "text"},
                        {"color", kChangeColour},
                        {"fontSize", 12},
                        {"fontWeight", 600},
                        {"baseline", "bottom"},
                        {"y", -3}}},
                      {"data", data},
                      {"encoding", {{"x", x}, {"text", {{"field", "label"}}}}}};
  return {rule, label};
}

}  // namespace

std::string trend_chart(const TrendLine& line) {
  Json chart = base_chart(150);
  chart["padding"] = {{"left", 2}, {"right", 22}, {"top", 18}, {"bottom", 4}};
  chart["layer"] = {measured_layer(line, "line"), level_layer(line), measured_layer(line, "point")};
  if (!line.changes.empty()) {
    for (const Json& layer : change_layers(line)) chart["layer"].push_back(layer);
  }
  return text_of(chart);
}

}  // namespace lightproof
