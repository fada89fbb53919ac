// What memory buys: the error of every estimator that keeps a table or a map, at one number of
// samples, against its size.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_charts.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kSamples = 64;
constexpr double kAlike = 1.1;  // errors of tables that are as good as the best

/// The point of so many samples, or the only one of an estimator that takes what it takes.
const AccuracyPoint* point_of(const AccuracyLine& line) {
  if (line.bytes == 0) return nullptr;
  if (line.points.size() == 1) return line.points.data();
  const auto found = std::ranges::find(line.points, kSamples, &AccuracyPoint::samples);
  return found == line.points.end() ? nullptr : &*found;
}

Json row_of(const AccuracyLine& line, const AccuracyPoint& point) {
  const double half = kBarHalfLength * point.rmse_error;
  const bool measured = is_measured(point);
  const auto shown = [](double error) { return drawable(error) ? rounded(error) : Json(nullptr); };
  return {{"series", to_string(line.family)},
          {"estimator", line.estimator},
          {"bytes", rounded(static_cast<double>(line.bytes))},
          {"rmse", measured ? shown(point.rmse) : Json(nullptr)},
          {"low", measured ? shown(std::max(point.rmse - half, 0.05 * point.rmse)) : Json(nullptr)},
          {"high", measured ? shown(point.rmse + half) : Json(nullptr)},
          {"predicted", shown(point.predicted)},
          {"size", bytes_text(static_cast<double>(line.bytes))},
          {"error", percent_with_error(point.rmse, point.rmse_error)},
          {"exact", drawable(point.predicted) ? percent(point.predicted) : "not known"}};
}

Json error_axis(const char* field) {
  Json y = quantity(field, "RMSE / mean (log)", "log");
  y["axis"] = {{"format", ".2~%"}};
  y["scale"]["padding"] = 12;
  return y;
}

/// A layer of marks at this field.
Json marks(const char* field, bool filled, const Json& colour, const Json& shape) {
  return {{"transform", {{{"filter", fmt::format("isValid(datum.{})", field)}}}},
          {"mark", {{"type", "point"}, {"filled", filled}, {"size", filled ? 60 : 130}}},
          {"encoding",
           {{"y", error_axis(field)},
            {"color", colour},
            {"shape", shape},
            {"tooltip",
             {tooltip("estimator", "estimator", ""), tooltip("size", "memory beside the map", ""),
              tooltip("error", "RMSE / mean \u00b1 SE", ""), tooltip("exact", "predicted", "")}}}}};
}

}  // namespace

std::string memory_finding(const AccuracyChart& chart) {
  struct Kept {
    const AccuracyLine* line;
    double error;
  };
  std::vector<Kept> kept;
  for (const AccuracyLine& line : chart.lines) {
    const AccuracyPoint* const point = point_of(line);
    if (point == nullptr || line.family != EstimatorFamily::environment) continue;
    if (const double error = known_error(*point); error > 0.0) kept.push_back({&line, error});
  }
  if (kept.empty()) return "Error against memory";
  const Kept best = *std::ranges::min_element(kept, {}, &Kept::error);
  const auto bytes_of = [](const Kept& one) { return one.line->bytes; };
  std::erase_if(kept, [&](const Kept& one) { return !(one.error <= kAlike * best.error); });
  const Kept smallest = *std::ranges::min_element(kept, {}, bytes_of);
  const auto words = [](const Kept& one) {
    return fmt::format("{} ({}, {})", one.line->estimator,
                       bytes_text(static_cast<double>(one.line->bytes)), percent(one.error));
  };
  if (smallest.line == best.line) {
    return fmt::format("At {} samples no smaller table of the map is as good as {}", kSamples,
                       words(best));
  }
  return fmt::format("At {} samples {} is as good as {}", kSamples, words(smallest), words(best));
}

std::string memory_chart(const std::vector<AccuracyChart>& charts) {
  const SceneChoice choice = accuracy_choice(charts);
  Json rows = Json::array();
  std::set<EstimatorFamily> families;
  LogRange sizes;
  for (const AccuracyChart& one : charts) {
    for (const AccuracyLine& line : one.lines) {
      const AccuracyPoint* const point = point_of(line);
      if (point == nullptr) continue;
      rows.push_back(row_of(line, *point));
      choice.put(rows.back(), scene_of(one));
      families.insert(line.family);
      sizes.add(static_cast<double>(line.bytes));
    }
  }
  if (rows.empty()) return "";
  std::vector<SeriesStyle> styles;
  for (const EstimatorFamily family : families) styles.push_back(family_style(family));
  const Json legend = {{"title", nullptr}, {"columns", 4}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  const Json shape = series(styles, &SeriesStyle::shape, legend);
  Json x = quantity("bytes", "memory beside the map (bytes, log)", "log");
  x["axis"] = log_axis(sizes.low, sizes.high, "format(datum.value, '~s')");
  x["scale"]["padding"] = 16;
  Json chart = base_chart(340);
  chart["params"] = choice.params();
  chart["transform"] = {choice.filter()};
  chart["data"] = {{"values", std::move(rows)}};
  chart["encoding"] = {{"x", x}};
  Json bars = error_bars(error_axis("low"), colour);
  bars["transform"] = {{{"filter", "isValid(datum.low)"}}};
  chart["layer"] = {marks("predicted", false, colour, shape), bars,
                    marks("rmse", true, colour, shape)};
  return text_of(chart);
}

}  // namespace lightproof
