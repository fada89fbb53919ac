#include "lightproof/page/chart_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace lightproof {
namespace {

// Okabe and Ito's colours (told apart under the common kinds of colour blindness), the yellow and
// the light blue replaced by darker ones that stand out on white.
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#b5478c",
                                                 "#8a6d00", "#4b3f9e", "#1a1a1a", "#7a7a7a"};
constexpr std::array<const char*, 8> kShapes = {"circle",         "square",       "triangle-up",
                                                "diamond",        "cross",        "triangle-down",
                                                "triangle-right", "triangle-left"};

Json axis_style() {
  return {{"labelFontSize", 12},      {"titleFontSize", 13},     {"titleFontWeight", 500},
          {"titlePadding", 10},       {"gridColor", "#e6e8eb"},  {"domainColor", "#7b848e"},
          {"tickColor", "#7b848e"},   {"labelColor", "#333b44"}, {"titleColor", "#1d232a"},
          {"labelOverlap", "greedy"}, {"labelSeparation", 6}};
}

Json scale_of(const std::vector<SeriesStyle>& styles, std::string SeriesStyle::*property) {
  Json domain = Json::array();
  Json range = Json::array();
  for (const SeriesStyle& style : styles) {
    domain.push_back(style.name);
    range.push_back(style.*property);
  }
  return {{"domain", domain}, {"range", range}};
}

}  // namespace

std::vector<std::string> unique_names(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  for (const std::string& name : names) {
    if (std::find(unique.begin(), unique.end(), name) == unique.end()) unique.push_back(name);
  }
  return unique;
}

std::vector<SeriesStyle> series_styles(const std::vector<std::string>& names) {
  std::vector<SeriesStyle> styles;
  for (const std::string& name : unique_names(names)) {
    // Every round of colours goes with other shapes.
    const std::size_t index = styles.size();
    const std::size_t round = index / kColours.size();
    styles.push_back(
        {name, kColours[index % kColours.size()], kShapes[(index + round) % kShapes.size()]});
  }
  return styles;
}

Json base_chart(int height) {
  Json chart = {{"width", "container"}, {"height", height}, {"background", "white"}};
  // Room for half of the last label of the x axis.
  chart["padding"] = {{"left", 2}, {"right", 22}, {"top", 4}, {"bottom", 4}};
  chart["autosize"] = {{"type", "fit-x"}, {"contains", "padding"}, {"resize", true}};
  chart["config"] = {{"font", "system-ui, -apple-system, 'Segoe UI', sans-serif"},
                     {"axis", axis_style()},
                     {"view", {{"stroke", nullptr}}},
                     {"legend",
                      {{"orient", "top"},
                       {"direction", "horizontal"},
                       {"columns", 4},
                       {"labelFontSize", 12},
                       {"labelLimit", 380},
                       {"titleFontSize", 12},
                       {"symbolSize", 90},
                       {"symbolOpacity", 1},
                       {"symbolStrokeWidth", 2}}}};
  return chart;
}

Json series(const std::vector<SeriesStyle>& styles, std::string SeriesStyle::*property,
            const Json& legend) {
  return {{"field", "series"},
          {"type", "nominal"},
          {"scale", scale_of(styles, property)},
          {"legend", legend}};
}

Json quantity(const std::string& field, const std::string& title, const std::string& scale) {
  Json encoding = {{"field", field}, {"type", "quantitative"}, {"title", title}};
  encoding["scale"] = {{"type", scale}};
  if (scale != "log") encoding["scale"]["zero"] = false;
  return encoding;
}

Json log_axis(double low, double high, const std::string& text) {
  // Labels stand at 1, 2 and 5, or at powers of ten where the range is wide; there the lines in
  // between step back, or go.
  const double span = high / low;
  const bool wide = !(span < 100.0);
  const std::string labelled =
      fmt::format("indexof([{}], slice(format(datum.value, '.0e'), 0, 1)) >= 0",
                  wide ? "'1'" : "'1', '2', '5'");
  const double minor = !wide ? 1.0 : span < 1e4 ? 0.5 : 0.0;
  const Json opacity = {{"condition", {{"test", labelled}, {"value", 1}}}, {"value", minor}};
  return {{"labelExpr", labelled + " ? " + text + " : ''"},
          {"gridOpacity", opacity},
          {"tickOpacity", opacity}};
}

Json error_bars(const Json& y, const Json& colour) {
  return {{"mark", {{"type", "rule"}, {"strokeWidth", 1.5}, {"opacity", 0.6}, {"clip", true}}},
          {"encoding", {{"y", y}, {"y2", {{"field", "high"}}}, {"color", colour}}}};
}

Json points(const Json& y, const Json& colour, const Json& shape) {
  return {{"mark", {{"type", "point"}, {"filled", true}, {"size", 55}, {"opacity", 0.9}}},
          {"encoding", {{"y", y}, {"color", colour}, {"shape", shape}}}};
}

Json tooltip(const std::string& field, const std::string& title, const std::string& format) {
  Json entry = {{"field", field}, {"title", title}};
  entry["type"] = format.empty() ? "nominal" : "quantitative";
  if (!format.empty()) entry["format"] = format;
  return entry;
}

void LogRange::add(double value) {
  if (!drawable(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.5g}", value));
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool drawable(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace lightproof
