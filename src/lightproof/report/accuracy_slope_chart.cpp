// Convergence rates of estimators at dependent points: by the kind of table, with standard errors.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_charts.h"

namespace lightproof {
namespace {

constexpr std::string_view kMonotone = "environment B";
constexpr std::string_view kAlias = "environment B alias";
constexpr const char* kIndependent = "random";

/// One slope: of which points, through what.
struct Slope {
  std::string points;  ///< "sobol"
  std::string source;  ///< "monotone table"
  const AccuracyLine* line;
};

/// "sobol" of the point set "brdf sobol" after "brdf"; "random" of "brdf" itself; empty of others.
std::string points_after(const AccuracyLine& line, std::string_view source) {
  const std::string_view estimator = line.estimator;
  if (estimator == source) return kIndependent;
  if (line.family != EstimatorFamily::points || !estimator.starts_with(source)) return "";
  const std::string_view rest = estimator.substr(source.size() + 1);
  return rest.find(' ') == std::string_view::npos ? std::string(rest) : "";
}

std::vector<Slope> slopes_of(const AccuracyChart& chart) {
  std::vector<Slope> slopes;
  for (const AccuracyLine& line : chart.lines) {
    if (!std::isfinite(line.slope)) continue;
    const auto add = [&](std::string_view source, const char* name) {
      std::string points = points_after(line, source);
      if (!points.empty()) slopes.push_back({std::move(points), name, &line});
    };
    add(kMonotone, "monotone table of the map");
    add(kAlias, "alias table of the map");
    add("brdf", "the material's lobe");
  }
  return slopes;
}

Json row_of(const Slope& slope) {
  const AccuracyLine& line = *slope.line;
  const double half = kBarHalfLength * line.slope_error;
  return {{"series", slope.source},
          {"points", slope.points},
          {"estimator", line.estimator},
          {"slope", rounded(line.slope)},
          {"low", rounded(line.slope - half)},
          {"high", rounded(line.slope + half)},
          {"text", with_error(line.slope, line.slope_error)}};
}

Json half_rule() {
  return {{"data", {{"values", {{{"expected", -0.5}}}}}},
          {"mark", {{"type", "rule"}, {"color", "#1d232a"}, {"strokeDash", {5, 4}}}},
          {"encoding", {{"x", {{"field", "expected"}, {"type", "quantitative"}}}}}};
}

Json dots_and_bars(const char* kind, const Json& x, const std::vector<SeriesStyle>& styles) {
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  const Json offset = {{"field", "series"}, {"type", "nominal"}};
  Json layer = {
      {"mark", {{"type", kind}}},
      {"encoding",
       {{"x", x}, {"yOffset", offset}, {"color", series(styles, &SeriesStyle::colour, legend)}}}};
  if (std::string_view(kind) == "rule") {
    layer["mark"]["strokeWidth"] = 1.5;
    layer["encoding"]["x2"] = {{"field", "high"}};
    return layer;
  }
  layer["mark"]["filled"] = true;
  layer["mark"]["size"] = 60;
  layer["encoding"]["shape"] = series(styles, &SeriesStyle::shape, legend);
  layer["encoding"]["tooltip"] = {tooltip("estimator", "estimator", ""),
                                  tooltip("points", "points", ""),
                                  tooltip("text", "slope \u00b1 SE", "")};
  return layer;
}

}  // namespace

std::string slope_chart(const std::vector<AccuracyChart>& charts) {
  const SceneChoice choice = accuracy_choice(charts);
  Json rows = Json::array();
  std::vector<std::string> sources;
  for (const AccuracyChart& one : charts) {
    for (const Slope& slope : slopes_of(one)) {
      rows.push_back(row_of(slope));
      choice.put(rows.back(), scene_of(one));
      sources.push_back(slope.source);
    }
  }
  if (rows.empty()) return "";
  const std::vector<SeriesStyle> styles = series_styles(sources);
  Json chart = base_chart(260);
  chart["params"] = choice.params();
  chart["transform"] = {choice.filter()};
  chart["data"] = {{"values", std::move(rows)}};
  chart["encoding"] = {
      {"y", {{"field", "points"}, {"type", "nominal"}, {"title", nullptr}, {"sort", nullptr}}}};
  const std::string title = "slope of log error over log samples";
  chart["layer"] = {dots_and_bars("rule", quantity("low", title, "linear"), styles),
                    dots_and_bars("point", quantity("slope", title, "linear"), styles)};
  Json rule = half_rule();
  rule["encoding"]["y"] = nullptr;
  chart["layer"].push_back(rule);
  return text_of(chart);
}

}  // namespace lightproof
