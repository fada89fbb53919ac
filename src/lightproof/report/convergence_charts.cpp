// Convergence: the error of every estimator against its number of samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "lightproof/page/chart_parts.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/scene_choice.h"

namespace lightproof {
namespace {

Json convergence_row(const ConvergenceRecord& r, const ConvergencePoint& p) {
  // A logarithmic axis has no room for an end at or below zero.
  const double low = std::max(p.rmse - kBarHalfLength * p.rmse_error, 0.05 * p.rmse);
  Json row = {{"series", r.estimator},
              {"n", p.samples},
              {"rmse", rounded(p.rmse)},
              {"drawn_low", rounded(low)},
              {"low", rounded(p.rmse - kBarHalfLength * p.rmse_error)},
              {"high", rounded(p.rmse + kBarHalfLength * p.rmse_error)}};
  row["predicted"] = drawable(p.predicted) ? rounded(p.predicted) : Json(nullptr);
  return row;
}

/// Every number of samples, or every second, third, … one so that at most `limit` remain.
Json sample_counts(const std::vector<ConvergenceRecord>& records, std::size_t limit) {
  std::set<std::uint64_t> counts;
  for (const ConvergenceRecord& r : records) {
    for (const ConvergencePoint& p : r.points) counts.insert(p.samples);
  }
  const std::size_t step = (counts.size() + limit - 1) / limit;
  Json kept = Json::array();
  std::size_t index = 0;
  for (const std::uint64_t count : counts) {
    if (index++ % step == 0) kept.push_back(count);
  }
  return kept;
}

Json samples_axis(const std::vector<ConvergenceRecord>& records, const char* title,
                  std::size_t labels) {
  Json x = quantity("n", title, "log");
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 12;
  x["axis"] = {{"values", sample_counts(records, labels)}, {"format", ",d"}};
  return x;
}

LogRange error_range(const std::vector<ConvergenceRecord>& records) {
  LogRange range;
  for (const ConvergenceRecord& r : records) {
    if (is_all_but_exact(r)) continue;
    for (const ConvergencePoint& p : r.points) {
      range.add(p.rmse);
      range.add(p.predicted);
    }
  }
  return range;
}

Json error_axis(const std::string& field, LogRange range) {
  Json y = quantity(field, "RMSE / mean (log)", "log");
  y["axis"] = log_axis(range.low, range.high);
  return y;
}

Json kind_of_line(const char* kind, bool legend) {
  Json dash = {{"datum", kind},
               {"type", "nominal"},
               {"scale",
                {{"domain", {"measured \u00b1 2 standard errors", "predicted"}},
                 {"range", {{1, 0}, {6, 4}}}}}};
  dash["legend"] = nullptr;
  if (legend) dash["legend"] = {{"title", nullptr}, {"symbolType", "stroke"}, {"symbolSize", 300}};
  return dash;
}

Json convergence_tooltip() {
  return {tooltip("series", "estimator", ""),
          tooltip("n", "samples N", ",d"),
          tooltip("rmse", "measured RMSE / mean", ".3~g"),
          tooltip("low", "minus 2 SE", ".3~g"),
          tooltip("high", "plus 2 SE", ".3~g"),
          tooltip("predicted", "predicted", ".3~g")};
}

Json line_layer(const Json& y, const Json& colour, const Json& dash) {
  const bool measured = y["field"] == "rmse";
  return {{"mark", {{"type", "line"}, {"strokeWidth", measured ? 2.0 : 1.5}}},
          {"encoding", {{"y", y}, {"color", colour}, {"strokeDash", dash}}}};
}

Json convergence_layers(const std::vector<SeriesStyle>& styles, LogRange range, bool legends) {
  const Json legend = legends ? Json{{"title", nullptr}} : Json(nullptr);
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  const Json shape = series(styles, &SeriesStyle::shape, legend);
  Json predicted =
      line_layer(error_axis("predicted", range), colour, kind_of_line("predicted", legends));
  predicted["transform"] = {{{"filter", "datum.predicted > 0"}}};
  const Json measured = line_layer(error_axis("rmse", range), colour,
                                   kind_of_line("measured \u00b1 2 standard errors", legends));
  const Json bars = {
      {"mark", {{"type", "rule"}, {"strokeWidth", 1.5}, {"clip", true}}},
      {"encoding",
       {{"y", error_axis("drawn_low", range)}, {"y2", {{"field", "high"}}}, {"color", colour}}}};
  const Json points = {
      {"mark", {{"type", "point"}, {"filled", true}, {"size", legends ? 55 : 28}, {"opacity", 1}}},
      {"encoding",
       {{"y", error_axis("rmse", range)},
        {"color", colour},
        {"shape", shape},
        {"tooltip", convergence_tooltip()}}}};
  return {predicted, bars, measured, points};
}

SceneKey scene_of(const ConvergenceRecord& r) { return {r.map, scene_name(r)}; }

/// The rows of all records, or those that belong to a chart with lists.
Json convergence_rows(const std::vector<ConvergenceRecord>& records, const SceneChoice* choice) {
  Json rows = Json::array();
  for (const ConvergenceRecord& r : records) {
    for (const ConvergencePoint& p : r.points) {
      if (!drawable(p.rmse) || is_all_but_exact(r)) continue;
      rows.push_back(convergence_row(r, p));
      if (choice != nullptr) choice->put(rows.back(), scene_of(r));
    }
  }
  return rows;
}

/// Where the slopes of most estimators could be fitted: there is something to see.
SceneKey scene_with_most_fits(const std::vector<ConvergenceRecord>& records) {
  std::map<SceneKey, int> fitted;
  int most = 0;
  for (const ConvergenceRecord& r : records) {
    most = std::max(most, fitted[scene_of(r)] += has_slope(r) ? 1 : 0);
  }
  const auto first = std::find_if(records.begin(), records.end(),
                                  [&](const auto& r) { return fitted[scene_of(r)] == most; });
  return scene_of(*first);
}

SceneChoice choice_of(const std::vector<ConvergenceRecord>& records) {
  std::vector<SceneKey> scenes;
  for (const ConvergenceRecord& r : records) scenes.push_back(scene_of(r));
  return {{{"map", "Map"}, {"scene", "Receiver, material"}}, scenes, scene_with_most_fits(records)};
}

std::vector<ConvergenceRecord> records_at(const std::vector<ConvergenceRecord>& records,
                                          const SceneKey& scene) {
  std::vector<ConvergenceRecord> here;
  std::copy_if(records.begin(), records.end(), std::back_inserter(here),
               [&](const ConvergenceRecord& r) { return scene_of(r) == scene; });
  return here;
}

/// What is found in one scene.
std::string scene_title(const std::vector<ConvergenceRecord>& records, const SceneKey& scene) {
  return fmt::format("{}, {}: {}", scene[0], scene[1],
                     convergence_finding(records_at(records, scene)));
}

}  // namespace

std::vector<SeriesStyle> estimator_styles(const std::vector<ConvergenceRecord>& records) {
  std::vector<std::string> names;
  for (const ConvergenceRecord& r : records) names.push_back(r.estimator);
  return series_styles(names);
}

std::string scene_name(const ConvergenceRecord& record) {
  return record.receiver + ", " + record.material;
}

std::string convergence_chart(const std::vector<ConvergenceRecord>& records) {
  const SceneChoice choice = choice_of(records);
  Json chart = base_chart(380);
  chart["params"] = choice.params();
  chart["transform"] = {choice.filter()};
  chart["data"] = {{"values", convergence_rows(records, &choice)}};
  chart["encoding"] = {{"x", samples_axis(records, "samples N per estimate (log)", 12)}};
  chart["layer"] = convergence_layers(estimator_styles(records), error_range(records), true);
  return text_of(chart);
}

std::vector<ChartTitle> convergence_titles(const std::vector<ConvergenceRecord>& records) {
  const SceneChoice choice = choice_of(records);
  std::set<SceneKey> scenes;
  for (const ConvergenceRecord& r : records) scenes.insert(scene_of(r));
  const SceneKey first = scene_with_most_fits(records);
  std::vector<ChartTitle> titles = {{choice.key(first), scene_title(records, first)}};
  for (const SceneKey& scene : scenes) {
    if (scene != first) titles.push_back({choice.key(scene), scene_title(records, scene)});
  }
  return titles;
}

std::string small_convergence_chart(const std::vector<ConvergenceRecord>& records,
                                    const std::string& map, const std::string& scene) {
  std::vector<ConvergenceRecord> shown;
  std::copy_if(records.begin(), records.end(), std::back_inserter(shown),
               [&](const ConvergenceRecord& r) { return scene_name(r) == scene; });
  const LogRange range = error_range(shown);
  std::erase_if(shown, [&](const ConvergenceRecord& r) { return r.map != map; });
  Json chart = base_chart(190);
  chart["data"] = {{"values", convergence_rows(shown, nullptr)}};
  chart["encoding"] = {{"x", samples_axis(records, "samples N (log)", 4)}};
  chart["layer"] = convergence_layers(estimator_styles(records), range, false);
  for (Json& layer : chart["layer"]) {
    layer["encoding"]["y"]["scale"]["domain"] = {range.low / 1.2, range.high * 1.2};
  }
  return text_of(chart);
}

}  // namespace lightproof
