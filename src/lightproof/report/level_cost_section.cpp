// Prefiltered levels: time against error by each method, and what a second thread gains.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "lightproof/core/machine.h"
#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/measured_csv.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr const char* kFrontColour = "#1d232a";

using Levels = std::vector<LevelCost>;

/// Whether another method makes the same level of the same map in no more time with no larger
/// error, and is better in one of them.
bool is_beaten(const LevelCost& cost, const Levels& all) {
  return std::ranges::any_of(all, [&](const LevelCost& other) {
    const double time = other.milliseconds.median;
    return other.map == cost.map && other.level == cost.level && time <= cost.milliseconds.median &&
           other.error <= cost.error &&
           (time < cost.milliseconds.median || other.error < cost.error);
  });
}

std::string label_of(const LevelCost& cost) {
  return cost.setting.empty() ? cost.method : cost.method + " with " + cost.setting;
}

Levels of_level(const Levels& all, const std::string& level) {
  Levels chosen;
  std::ranges::copy_if(all, std::back_inserter(chosen),
                       [&](const LevelCost& cost) { return cost.level == level; });
  return chosen;
}

/// Medians over the maps, of one method with one setting.
struct Typical {
  std::string name;
  double milliseconds = 0.0;
  double error = 0.0;
};

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Typical> typical_costs(const Levels& level) {
  std::vector<std::string> names;
  for (const LevelCost& cost : level) names.push_back(label_of(cost));
  std::vector<Typical> all;
  for (const std::string& name : unique_names(names)) {
    std::vector<double> times;
    std::vector<double> errors;
    for (const LevelCost& cost : level) {
      if (label_of(cost) != name) continue;
      times.push_back(cost.milliseconds.median);
      errors.push_back(cost.error);
    }
    all.push_back({name, middle(times), middle(errors)});
  }
  return all;
}

std::string cost_text(const Typical& cost) {
  return fmt::format("{} ms for an error of {} by {}", format_number(cost.milliseconds, 2),
                     format_number(cost.error, 2), cost.name);
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() += 'A' - 'a';
  return text;
}

/// Errors below this are those of the quadrature that levels are compared with.
constexpr double kOfQuadrature = 1e-5;

/// The fastest of the most exact methods beside the usual loop, at its most samples.
std::string level_finding(const std::string& name, const Levels& level) {
  const std::vector<Typical> costs = typical_costs(level);
  const double least = std::ranges::min_element(costs, {}, &Typical::error)->error;
  const auto by_speed = [&](const Typical& cost) {
    return cost.error <= std::max(least, kOfQuadrature) ? cost.milliseconds : HUGE_VAL;
  };
  const Typical& best = *std::ranges::min_element(costs, {}, by_speed);
  const Typical* usual = nullptr;
  for (const Typical& cost : costs) {
    if (cost.name.starts_with("half-vector with")) usual = &cost;  // the last one has most samples
  }
  std::string text = fmt::format("{}: {}", capitalised(name), cost_text(best));
  if (usual != nullptr && usual != &best) text += ", " + cost_text(*usual);
  return text;
}

Json row_of(const LevelCost& cost, const Levels& all) {
  // A logarithmic axis has no room for an end at zero.
  return {{"series", cost.method},
          {"map", cost.map},
          {"label", label_of(cost)},
          {"ms", rounded(cost.milliseconds.median)},
          {"ms_low", rounded(cost.milliseconds.low)},
          {"ms_high", rounded(cost.milliseconds.high)},
          {"error", rounded(cost.error)},
          {"error_low", rounded(cost.error_low)},
          {"drawn_low", rounded(std::max(cost.error_low, 0.2 * cost.error))},
          {"error_high", rounded(cost.error_high)},
          {"front", is_beaten(cost, all) ? "beaten in both" : "on the front"}};
}

Json log_quantity(const char* field, const char* title, const LogRange& range) {
  Json axis = quantity(field, title, "log");
  axis["axis"] = log_axis(range.low, range.high);
  axis["scale"]["nice"] = false;
  axis["scale"]["padding"] = 20;
  return axis;
}

Json filtered(Json layer, const char* filter) {
  layer["transform"] = Json::array({{{"filter", filter}}});
  return layer;
}

/// Shows the rows of one map at a time, which the reader chooses, if there are several.
void choose_map(Json& chart, const std::vector<std::string>& maps) {
  if (maps.size() < 2) return;
  chart["params"] =
      Json::array({{{"name", "chosen_map"},
                    {"value", maps.front()},
                    {"bind", {{"input", "select"}, {"options", maps}, {"name", "Map"}}}}});
  chart["transform"] = Json::array({{{"filter", "datum.map === chosen_map"}}});
}

std::string level_chart(const Levels& level) {
  Json rows = Json::array();
  LogRange times;
  LogRange errors;
  std::vector<std::string> methods;
  std::vector<std::string> maps;
  for (const LevelCost& cost : level) {
    methods.push_back(cost.method);
    maps.push_back(cost.map);
    if (!drawable(cost.error) || !drawable(cost.milliseconds.median)) continue;
    times.add(cost.milliseconds.median);
    errors.add(cost.error);
    rows.push_back(row_of(cost, level));
    rows.back()["place"] = rows.size();
  }
  const std::vector<SeriesStyle> styles = series_styles(methods);
  const Json legend = {{"title", nullptr}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json chart = base_chart(360);
  chart["data"] = {{"values", rows}};
  choose_map(chart, unique_names(maps));
  chart["encoding"] = {{"x", log_quantity("ms", "time to make the level (ms, log)", times)},
                       {"y", log_quantity("error", "relative RMS error (log)", errors)}};
  const char* on_front = "datum.front == 'on the front'";
  const Json front =
      filtered({{"mark",
                 {{"type", "line"},
                  {"color", kFrontColour},
                  {"strokeWidth", 1.5},
                  {"strokeDash", {4, 3}},
                  {"interpolate", "step-after"}}},
                {"encoding", {{"order", {{"field", "ms"}, {"type", "quantitative"}}}}}},
               on_front);
  const Json rings = filtered(
      {{"mark", {{"type", "point"}, {"shape", "circle"}, {"size", 220}, {"color", kFrontColour}}},
       {"encoding", Json::object()}},
      on_front);
  const Json lines = {
      {"mark", {{"type", "line"}, {"strokeWidth", 1.5}, {"opacity", 0.5}}},
      {"encoding", {{"color", colour}, {"order", {{"field", "place"}, {"type", "quantitative"}}}}}};
  Json low = chart["encoding"]["y"];
  low["field"] = "drawn_low";
  Json bars = error_bars(low, colour);
  bars["encoding"]["y2"] = {{"field", "error_high"}};
  const Json dots = {
      {"mark", {{"type", "point"}, {"filled", true}, {"size", 70}, {"opacity", 1}}},
      {"encoding",
       {{"color", colour},
        {"shape", series(styles, &SeriesStyle::shape, legend)},
        {"tooltip",
         {tooltip("label", "method", ""), tooltip("ms", "ms", ".3~g"),
          tooltip("ms_low", "fastest, ms", ".3~g"), tooltip("ms_high", "slowest, ms", ".3~g"),
          tooltip("error", "relative error", ".2~g"), tooltip("error_low", "from", ".2~g"),
          tooltip("error_high", "to", ".2~g"), tooltip("front", "Pareto front", "")}}}}};
  chart["layer"] = {lines, bars, front, rings, dots};
  return text_of(chart);
}

std::string level_table(const Levels& level, const Levels& all) {
  Table table("Time and error of levels",
              {"Map", "Size", "Method", "Setting", "Median, ms", "Fastest, ms", "Slowest, ms",
               "Relative error", "95 % limits", "Pareto front"});
  for (const LevelCost& r : level) {
    table.add(
        {text_cell(r.map),
         {extent_text(r.map_extent), "number", ""},
         text_cell(r.method),
         text_cell(r.setting.empty() ? "\u2013" : r.setting),
         number_cell(r.milliseconds.median),
         number_cell(r.milliseconds.low),
         number_cell(r.milliseconds.high),
         number_cell(r.error, 2),
         {fmt::format("{} to {}", format_number(r.error_low, 2), format_number(r.error_high, 2)),
          "number", ""},
         text_cell(is_beaten(r, all) ? "" : "on it")});
  }
  return table.html();
}

std::string busy_text(const std::vector<ThreadGain>& gains) {
  double ratio = 0.0;
  for (const ThreadGain& gain : gains) ratio = std::max(ratio, gain.wall_over_processor);
  if (!(ratio > 0.0)) return "";
  if (ratio <= kBusyRatio)
    return " The machine was idle: work on one thread got a processor all the time.";
  return fmt::format(
      " The machine was busy: work on one thread took up to {} times the processor time that it "
      "got, and times are too long by about as much.",
      format_number(ratio, 2));
}

std::string level_note(const LevelCost& one) {
  return fmt::format(
      "A level of {} texels, on all threads that the study may use; each method once to warm up, "
      "then in turns; medians. The error is the root mean square of the difference from "
      "quadrature, "
      "over the root mean square of the level, at {} texels drawn at random; below some 1e\u22125 "
      "it "
      "is the quadrature's own. Methods are those of `lightproof precompute --method`: "
      "`half-vector` "
      "is the usual loop, `filtered` filtered importance sampling. Along the dashed line, from "
      "ring "
      "to ring, nothing gets faster without a larger error; bars are 95 % limits, which are wide "
      "where "
      "few texels see a small sun.",
      extent_text(one.level_extent), one.texels);
}

std::string id_of(std::size_t place) { return fmt::format("levels-{}", place + 1); }

std::string gain_finding(const std::vector<ThreadGain>& gains) {
  std::string text = "A second thread makes";
  for (std::size_t i = 0; i < gains.size(); ++i) {
    text += fmt::format("{} the {} {} times as fast", i == 0 ? "" : ",", gains[i].work,
                        format_number(gains[i].one.median / gains[i].two.median, 2));
  }
  return text;
}

Cell time_cell(const TimeRange& time) {
  return {fmt::format("{} ({} to {})", format_number(time.median), format_number(time.low),
                      format_number(time.high)),
          "number", ""};
}

std::string gain_part(const std::vector<ThreadGain>& gains) {
  if (gains.empty()) return "";
  Table table("One thread and two", {"Work", "One thread, ms", "Two threads, ms", "Times as fast",
                                     "Wall over processor time"});
  for (const ThreadGain& r : gains) {
    table.add({text_cell(r.work), time_cell(r.one), time_cell(r.two),
               number_cell(r.one.median / r.two.median, 2), number_cell(r.wall_over_processor, 2)});
  }
  return "<h3>" + escaped(gain_finding(gains)) + "</h3>\n" +
         paragraph(
             "Of the built-in map sun-sky; medians of runs in turns, and the fastest and slowest. "
             "Two threads on two "
             "hardware threads of one core, or beside other programs, gain less than two "
             "free cores would." +
                 busy_text(gains),
             "note") +
         table.html() + download_link("thread-gains.csv", thread_gains_csv(gains));
}

}  // namespace

std::string level_cost_section(const LevelCosts& costs) {
  std::string html = "<section id=\"levels\">\n<h2>Prefiltered levels</h2>\n";
  if (costs.levels.empty() && costs.gains.empty()) {
    return html + paragraph("Times of prefiltering were not measured in this study.", "empty") +
           "</section>\n";
  }
  if (!costs.origin.empty()) html += paragraph("Measured " + costs.origin + ".", "note");
  std::vector<std::string> names;
  for (const LevelCost& cost : costs.levels) names.push_back(cost.level);
  names = unique_names(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Levels level = of_level(costs.levels, names[i]);
    const bool is_last = i + 1 == names.size();
    html += chart_figure(
        {id_of(i), level_finding(names[i], level),
         fmt::format("Error against time of every method, of {}", names[i]),
         i == 0 ? level_note(level.front()) : "", level_chart(level)},
        collapsible("Methods as a table", level_table(level, costs.levels)) +
            (is_last ? download_link("levels.csv", level_costs_csv(costs.levels)) : ""));
  }
  return html + gain_part(costs.gains) + "</section>\n";
}

}  // namespace lightproof
