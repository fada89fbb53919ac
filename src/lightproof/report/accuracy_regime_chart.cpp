// Which method wins where: over the roughness of the material and the concentration of the light.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_charts.h"

namespace lightproof {
namespace {

constexpr const char* kAll = "all estimators";
constexpr const char* kUnbiased = "unbiased ones alone";

std::string name_or_none(const std::string& estimator) {
  return estimator.empty() ? "none" : estimator;
}

Json row_of(const MethodRegime& r, bool is_unbiased) {
  const std::string& estimator = is_unbiased ? r.unbiased_estimator : r.estimator;
  const double seconds = is_unbiased ? r.unbiased_seconds : r.seconds;
  return {{"shown", is_unbiased ? kUnbiased : kAll},
          {"series", name_or_none(estimator)},
          {"roughness", format_number(r.roughness, 2)},
          {"light", percent(r.effective_fraction)},
          {"time", estimator.empty() ? "\u2013" : seconds_text(seconds)}};
}

/// Wide lights at the top.
Json lights_of(std::vector<MethodRegime> regimes) {
  std::stable_sort(regimes.begin(), regimes.end(), [](const auto& a, const auto& b) {
    return a.effective_fraction > b.effective_fraction;
  });
  std::vector<std::string> names;
  for (const MethodRegime& r : regimes) names.push_back(percent(r.effective_fraction));
  return unique_names(names);
}

Json axis(const char* field, const char* title) {
  return {{"field", field}, {"type", "ordinal"}, {"title", title}, {"sort", nullptr}};
}

Json cells(const std::vector<SeriesStyle>& styles) {
  const Json legend = {{"title", nullptr}, {"columns", 4}};
  return {{"mark", {{"type", "rect"}, {"stroke", "white"}, {"strokeWidth", 2}}},
          {"encoding",
           {{"color", series(styles, &SeriesStyle::colour, legend)},
            {"tooltip",
             {tooltip("series", "fastest", ""), tooltip("time", "time of a shading point", ""),
              tooltip("roughness", "roughness", ""),
              tooltip("light", "share of the sphere that is lit", "")}}}}};
}

Json times() {
  return {{"mark", {{"type", "text"}, {"fontSize", 11}, {"color", "white"}}},
          {"encoding", {{"text", {{"field", "time"}, {"type", "nominal"}}}}}};
}

}  // namespace

std::string regime_chart(const MethodRegimes& regimes) {
  Json rows = Json::array();
  std::vector<std::string> names;
  for (const bool is_unbiased : {false, true}) {
    for (const MethodRegime& r : regimes.regimes) {
      rows.push_back(row_of(r, is_unbiased));
      names.push_back(name_or_none(is_unbiased ? r.unbiased_estimator : r.estimator));
    }
  }
  const SceneChoice choice({{"shown", "Show"}}, {{kAll}, {kUnbiased}}, {kAll});
  Json light = axis("light", "effective fraction: share of the sphere that is lit");
  light["scale"] = {{"domain", lights_of(regimes.regimes)}};
  Json chart = base_chart(300);
  chart["params"] = choice.params();
  chart["transform"] = {choice.filter()};
  chart["data"] = {{"values", std::move(rows)}};
  chart["encoding"] = {{"x", axis("roughness", "roughness of GGX")}, {"y", light}};
  chart["encoding"]["x"]["axis"] = {{"labelAngle", 0}};
  chart["layer"] = {cells(series_styles(names)), times()};
  return text_of(chart);
}

}  // namespace lightproof
