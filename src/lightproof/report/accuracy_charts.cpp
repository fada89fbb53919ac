// Speed against accuracy: the chart of one map, receiver and material at a time.
#include "lightproof/report/accuracy_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr double kLeastDrawn = 1e-4;  // RMSE over the mean
constexpr double kMostDrawn = 10.0;
/// How many shading points share a set-up, by the choice of the list; 0 if it is not counted.
constexpr std::array<double, 4> kSetUpShares = {0.0, 1e-6, 1e-4, 1e-2};
constexpr std::array<const char*, 4> kSetUpWords = {
    "not counted", "shared by 1,000,000 points", "shared by 10,000 points", "shared by 100 points"};
constexpr const char* kFaint = "#d3d8de";
constexpr const char* kFrontColour = "#1d232a";

std::vector<SeriesStyle> family_styles(const std::vector<AccuracyChart>& charts) {
  std::set<EstimatorFamily> families;
  for (const AccuracyChart& chart : charts) {
    for (const AccuracyLine& line : chart.lines) families.insert(line.family);
  }
  std::vector<SeriesStyle> styles;
  for (const EstimatorFamily family : families) styles.push_back(family_style(family));
  return styles;
}

/// All layers share one legend, so all say the same of it.
Json family_encoding(const std::vector<SeriesStyle>& styles, std::string SeriesStyle::*property) {
  Json encoding =
      series(styles, property,
             {{"title", "families (click to show one)"}, {"titleLimit", 400}, {"columns", 5}});
  encoding["field"] = "family";
  return encoding;
}

Json drawn(double error) {
  if (!drawable(error)) return nullptr;
  return rounded(std::clamp(error, kLeastDrawn, kMostDrawn));
}

Json point_row(const AccuracyLine& line, std::size_t i) {
  const AccuracyPoint& p = line.points[i];
  const bool measured = is_measured(p);
  const double half = kBarHalfLength * p.rmse_error;
  Json row = {{"series", line.estimator},
              {"family", to_string(line.family)},
              {"n", p.samples},
              {"seconds", rounded(p.seconds)},
              {"setup", rounded(line.set_up_processor_seconds)},
              {"time", seconds_text(p.seconds)},
              {"prepared", seconds_text(line.set_up_processor_seconds)},
              {"memory", bytes_text(static_cast<double>(line.bytes))},
              {"rmse", measured ? drawn(p.rmse) : Json(nullptr)}};
  row["low"] = measured && half > 0.0 ? drawn(std::max(p.rmse - half, 0.05 * p.rmse)) : row["rmse"];
  row["high"] = measured ? drawn(p.rmse + half) : Json(nullptr);
  row["predicted"] = drawn(p.predicted);
  row["error"] = percent_with_error(p.rmse, p.rmse_error) + (measured ? "" : " (not measured)");
  row["exact"] = drawable(p.predicted) ? percent(p.predicted) : "not known";
  return row;
}

/// From the mark to the right edge of the chart.
Json floor_row(const AccuracyLine& line, double right) {
  return {{"series", line.estimator},
          {"family", to_string(line.family)},
          {"floor", drawn(line.floor)},
          {"seconds", rounded(line.points.back().seconds)},
          {"setup", rounded(line.set_up_processor_seconds)},
          {"right", rounded(right)}};
}

/// A point of the front by one choice of how the set-up is shared.
Json front_row(const ChartPoint& p, std::size_t choice) {
  return {{"seconds", rounded(total_seconds(p, kSetUpShares[choice]))},
          {"setup", 0},
          {"front", drawn(known_error(*p.point))},
          {"choice", choice}};
}

/// Whether a line leads, by each choice of how the set-up is shared.
Json choices_led(const AccuracyChart& chart, const AccuracyLine& line) {
  Json leads = Json::array();
  for (const double share : kSetUpShares) {
    const auto leading = leading_lines(chart, share);
    leads.push_back(std::find(leading.begin(), leading.end(), &line) != leading.end());
  }
  return leads;
}

double longest(const AccuracyChart& chart) {
  double seconds = 0.0;
  for (const AccuracyLine& line : chart.lines) {
    for (const AccuracyPoint& point : line.points) seconds = std::max(seconds, point.seconds);
  }
  return seconds;
}

/// The rows of all layers of one scene.
Json rows_of(const AccuracyChart& chart, const SceneChoice& choice) {
  Json rows = Json::array();
  const double right = longest(chart);
  for (const AccuracyLine& line : chart.lines) {
    const Json leads = choices_led(chart, line);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      rows.push_back(point_row(line, i));
      rows.back()["leads"] = leads;
    }
    if (!(line.floor > 0.0)) continue;
    rows.push_back(floor_row(line, right));
    rows.back()["leads"] = leads;
  }
  for (std::size_t i = 0; i < kSetUpShares.size(); ++i) {
    for (const ChartPoint& p : pareto_front(chart, kSetUpShares[i])) {
      rows.push_back(front_row(p, i));
    }
  }
  for (Json& row : rows) choice.put(row, scene_of(chart));
  return rows;
}

/// Whether a mark is shown in its colour: its family was clicked, it is pointed at, or no family
/// was clicked and it leads.
Json is_lit() {
  return {{"or",
           {{{"param", "family"}, {"empty", false}},
            {{"param", "pointed_at"}, {"empty", false}},
            {{"and", {{{"param", "family"}}, "datum.leads[set_up]"}}}}}};
}

Json opacity(double lit, double unlit) {
  return {{"condition", {{"test", is_lit()}, {"value", lit}}}, {"value", unlit}};
}

Json time_axis(const LogRange& range) {
  Json x = quantity("total", "time of one shading point (log)", "log");
  x["axis"] = log_axis(range.low, range.high,
                       "replace(format(datum.value, '~s'), regexp('([0-9.]+)'), '$1 ') + 's'");
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 12;
  return x;
}

Json error_axis(const std::string& field) {
  Json y = quantity(field, "RMSE / mean (log)", "log");
  y["axis"] = log_axis(kLeastDrawn, kMostDrawn, "format(100 * datum.value, ',~g') + ' %'");
  y["scale"]["domainMax"] = kMostDrawn;
  y["scale"]["nice"] = false;
  y["scale"]["padding"] = 12;
  return y;
}

/// The list that says how the set-up is shared; its value is the index in kSetUpShares.
Json set_up_list() {
  Json steps = Json::array();
  for (std::size_t i = 0; i < kSetUpShares.size(); ++i) steps.push_back(i);
  return {{"name", "set_up"},
          {"value", 0},
          {"bind",
           {{"input", "select"}, {"options", steps}, {"labels", kSetUpWords}, {"name", "Set-up"}}}};
}

Json with_share_of_set_up() {
  const std::string shares = Json(kSetUpShares).dump();
  return {{"calculate", "datum.seconds + " + shares + "[set_up] * datum.setup"}, {"as", "total"}};
}

/// The front by the chosen share of the set-up.
Json only_front() { return {{{"filter", "isValid(datum.front) && datum.choice === set_up"}}}; }

Json only(const std::string& field) { return {{{"filter", "isValid(datum." + field + ")"}}}; }

Json accuracy_tooltip() {
  return {tooltip("series", "estimator", ""),
          tooltip("family", "family", ""),
          tooltip("n", "samples N", ",d"),
          tooltip("time", "time of a shading point", ""),
          tooltip("prepared", "set-up, all threads", ""),
          tooltip("memory", "memory beside the map", ""),
          tooltip("error", "RMSE / mean \u00b1 SE", ""),
          tooltip("exact", "predicted", "")};
}

/// Every line in grey, under those that are lit.
Json faint_lines() {
  return {{"transform", only("n")},
          {"mark", {{"type", "line"}, {"strokeWidth", 1}, {"color", kFaint}}},
          {"encoding", {{"y", error_axis("rmse")}, {"detail", {{"field", "series"}}}}}};
}

Json lit_lines(const std::string& field, const Json& colour, bool dashed) {
  Json mark = {{"type", "line"}, {"strokeWidth", dashed ? 1.0 : 2.0}};
  if (dashed) mark["strokeDash"] = {5, 4};
  return {{"transform", only("n")},
          {"mark", mark},
          {"encoding",
           {{"y", error_axis(field)},
            {"color", colour},
            {"detail", {{"field", "series"}}},
            {"opacity", opacity(1.0, 0.0)}}}};
}

Json floors(const Json& colour) {
  return {{"transform", only("floor")},
          {"mark", {{"type", "rule"}, {"strokeWidth", 1.2}, {"strokeDash", {2, 3}}}},
          {"encoding",
           {{"y", error_axis("floor")},
            {"x2", {{"field", "right"}}},
            {"color", colour},
            {"opacity", opacity(0.75, 0.0)}}}};
}

Json bars(const Json& colour) {
  Json layer = error_bars(error_axis("low"), colour);
  layer["transform"] = only("rmse");
  layer["mark"].erase("opacity");
  layer["encoding"]["opacity"] = opacity(0.6, 0.0);
  return layer;
}

Json front_line() {
  return {{"transform", only_front()},
          {"mark",
           {{"type", "line"},
            {"color", kFrontColour},
            {"strokeWidth", 5},
            {"opacity", 0.13},
            {"interpolate", "step-after"}}},
          {"encoding", {{"y", error_axis("front")}}}};
}

/// Rings around what nothing beats.
Json front_rings() {
  return {{"transform", only_front()},
          {"mark",
           {{"type", "point"},
            {"shape", "circle"},
            {"size", 150},
            {"strokeWidth", 1.2},
            {"color", kFrontColour}}},
          {"encoding", {{"y", error_axis("front")}}}};
}

/// The marks that are pointed at and, in the legend, clicked.
Json dots(const std::vector<SeriesStyle>& styles) {
  const Json colour = family_encoding(styles, &SeriesStyle::colour);
  const Json shape = family_encoding(styles, &SeriesStyle::shape);
  return {{"transform", only("rmse")},
          {"params",
           {{{"name", "family"},
             {"select", {{"type", "point"}, {"fields", {"family"}}, {"toggle", "true"}}},
             {"bind", "legend"}},
            {{"name", "pointed_at"},
             {"select",
              {{"type", "point"},
               {"fields", {"series"}},
               {"on", "pointerover"},
               {"clear", "pointerout"}}}}}},
          {"mark", {{"type", "point"}, {"filled", true}}},
          {"encoding",
           {{"y", error_axis("rmse")},
            {"color", colour},
            {"shape", shape},
            {"size", {{"condition", {{"test", is_lit()}, {"value", 48}}}, {"value", 14}}},
            {"opacity", opacity(1.0, 0.18)},
            {"tooltip", accuracy_tooltip()}}}};
}

}  // namespace

SeriesStyle family_style(EstimatorFamily family) {
  const auto style = [family](const char* colour, const char* shape) {
    return SeriesStyle{std::string(to_string(family)), colour, shape};
  };
  switch (family) {
    case EstimatorFamily::uniform:
      return style("#8a6d00", "circle");
    case EstimatorFamily::lobes:
      return style("#d55e00", "square");
    case EstimatorFamily::environment:
      return style("#0072b2", "triangle-up");
    case EstimatorFamily::product:
      return style("#009e73", "diamond");
    case EstimatorFamily::mis:
      return style("#b5478c", "cross");
    case EstimatorFamily::ris:
      return style("#4b3f9e", "triangle-down");
    case EstimatorFamily::points:
      return style("#00909e", "triangle-right");
    case EstimatorFamily::lights:
      return style("#b3121d", "triangle-left");
    case EstimatorFamily::quadrature:
      return style("#5f6b78", "square");
    case EstimatorFamily::precomputed:
      return style("#1a1a1a", "circle");
  }
  return style("#7a7a7a", "circle");
}

SceneKey scene_of(const AccuracyChart& chart) {
  return {chart.map, chart.receiver, chart.material};
}

SceneChoice accuracy_choice(const std::vector<AccuracyChart>& charts) {
  std::vector<SceneKey> scenes;
  for (const AccuracyChart& chart : charts) scenes.push_back(scene_of(chart));
  const auto open = std::find_if(charts.begin(), charts.end(),
                                 [](const AccuracyChart& chart) { return !chart.is_occluded; });
  const AccuracyChart& first = open == charts.end() ? charts.front() : *open;
  return {{{"map", "Map"}, {"receiver", "Receiver"}, {"material", "Material"}},
          scenes,
          scene_of(first)};
}

std::string accuracy_chart(const std::vector<AccuracyChart>& charts) {
  const SceneChoice choice = accuracy_choice(charts);
  Json rows = Json::array();
  LogRange times;
  for (const AccuracyChart& one : charts) {
    for (Json& row : rows_of(one, choice)) rows.push_back(std::move(row));
    for (const AccuracyLine& line : one.lines) {
      for (const AccuracyPoint& point : line.points) {
        times.add(point.seconds);
        times.add(total_seconds({&line, &point}, kSetUpShares.back()));
      }
    }
  }
  const std::vector<SeriesStyle> styles = family_styles(charts);
  const Json colour = family_encoding(styles, &SeriesStyle::colour);
  Json chart = base_chart(460);
  chart["params"] = choice.params();
  chart["params"].push_back(set_up_list());
  chart["transform"] = {choice.filter(), with_share_of_set_up()};
  chart["data"] = {{"values", std::move(rows)}};
  chart["encoding"] = {{"x", time_axis(times)}};
  chart["layer"] = {front_line(),
                    faint_lines(),
                    floors(colour),
                    lit_lines("predicted", colour, true),
                    lit_lines("rmse", colour, false),
                    bars(colour),
                    dots(styles),
                    front_rings()};
  return text_of(chart);
}

}  // namespace lightproof
