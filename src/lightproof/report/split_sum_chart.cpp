// The split sum's error over roughness and view angle, as heat maps.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/core/measure.h"
#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

/// The ends of the colours, of all maps: errors beyond have the end's colour.
constexpr double kLowest = 1e-3;
constexpr double kHighest = 10.0;
/// Pixels that the columns of numbers need.
constexpr int kNumbersWidth = 560;
/// From here on cells are dark.
constexpr double kDark = 0.5;

Json split_sum_rows(const std::vector<SplitSumRecord>& records, bool with_choice) {
  Json rows = Json::array();
  for (const SplitSumRecord& r : records) {
    rows.push_back({{"angle", std::lround(view_degrees(r))},
                    {"roughness", rounded(r.roughness)},
                    {"rmse", rounded(r.rmse)},
                    {"most", rounded(std::hypot(r.rmse, r.left_out))},
                    {"text", split_sum_text(r)}});
    if (!with_choice) continue;
    rows.back()["map"] = r.map;
    rows.back()["f0"] = plain_number(r.normal_reflectance);
  }
  return rows;
}

Json ordinal(const char* field, const char* title, const char* label) {
  return {{"field", field},
          {"type", "ordinal"},
          {"title", title},
          {"axis", {{"labelExpr", label}, {"labelAngle", 0}, {"domain", false}, {"ticks", false}}}};
}

Json axes() {
  Json roughness = ordinal("roughness", "roughness", "datum.label");
  roughness["sort"] = "descending";
  return {{"x", ordinal("angle", "angle between view and normal", "datum.label + '\u00b0'")},
          {"y", roughness}};
}

Json colour(bool legend) {
  Json channel = {{"field", "rmse"},
                  {"type", "quantitative"},
                  {"scale",
                   {{"type", "log"},
                    {"domain", {kLowest, kHighest}},
                    {"clamp", true},
                    {"scheme", "yelloworangered"}}}};
  channel["legend"] = nullptr;
  if (legend) {
    channel["legend"] = {
        {"title", "RMS error / mean (log)"},
        {"values", {0.001, 0.01, 0.1, 1.0, 10.0}},
        {"labelExpr",
         "datum.value == 0.001 ? '\u2264 0.1 %' : datum.value == 10 ? '\u2265 1000 "
         "%' : format(100 * datum.value, 'd') + ' %'"},
        {"gradientLength", 300}};
  }
  return channel;
}

Json split_sum_tooltip() {
  return {tooltip("roughness", "roughness", ".2~g"), tooltip("angle", "view angle (\u00b0)", "d"),
          tooltip("rmse", "RMS error / mean", ".3~g"),
          tooltip("most", "with finer detail, at most", ".3~g")};
}

Json fields(bool legend) {
  return {{"mark", {{"type", "rect"}, {"stroke", "white"}, {"strokeWidth", 1}}},
          {"encoding", {{"color", colour(legend)}, {"tooltip", split_sum_tooltip()}}}};
}

Json numbers() {
  const Json dark = {{"test", "datum.rmse >= " + significant(kDark)}, {"value", "white"}};
  return {
      {"mark",
       {{"type", "text"},
        {"fontSize", 12},
        {"tooltip", nullptr},
        {"opacity", {{"expr", fmt::format("width < {} ? 0 : 1", kNumbersWidth)}}}}},
      {"encoding",
       {{"text", {{"field", "text"}}}, {"color", {{"condition", dark}, {"value", "#1d232a"}}}}}};
}

Json choice(const char* param, const char* label, const Json& options) {
  return {{"name", param},
          {"value", options.front()},
          {"bind", {{"input", "select"}, {"options", options}, {"name", label}}}};
}

}  // namespace

std::string split_sum_chart(const std::vector<SplitSumRecord>& records) {
  std::vector<std::string> maps;
  std::vector<std::string> reflectances;
  for (const SplitSumRecord& r : records) {
    maps.push_back(r.map);
    reflectances.push_back(plain_number(r.normal_reflectance));
  }
  Json chart = base_chart(340);
  chart["params"] = {choice("chosen_map", "Map", unique_names(maps)),
                     choice("chosen_f0", "F0", unique_names(reflectances))};
  chart["transform"] = {{{"filter", "datum.map === chosen_map && datum.f0 === chosen_f0"}}};
  chart["data"] = {{"values", split_sum_rows(records, true)}};
  chart["encoding"] = axes();
  chart["layer"] = {fields(true), numbers()};
  return text_of(chart);
}

std::string small_split_sum_chart(const std::vector<SplitSumRecord>& records) {
  Json chart = base_chart(190);
  chart["data"] = {{"values", split_sum_rows(records, false)}};
  chart["encoding"] = axes();
  chart["layer"] = {fields(false)};
  return text_of(chart);
}

}  // namespace lightproof
