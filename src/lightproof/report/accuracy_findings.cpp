#include "lightproof/report/accuracy_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr double kLowError = 0.01;
constexpr std::string_view kSimplest = "uniform";

std::string samples_text(const FastestLine& fastest) {
  const auto samples = whole_samples(fastest.point);
  if (fastest.line->points.size() == 1) return fastest.line->estimator;
  return fmt::format("{}, {}", fastest.line->estimator, counted(samples, "sample"));
}

/// "5 % error takes 1.3 µs (environment B, 40 samples)".
std::string time_to(const AccuracyChart& chart, double error) {
  const std::optional<FastestLine> fastest = fastest_to(chart, error);
  if (!fastest) return fmt::format("{} error is reached by none", percent(error));
  return fmt::format("{} error takes {} ({})", percent(error), seconds_text(fastest->point.seconds),
                     samples_text(*fastest));
}

/// How many times as long as the fastest the simplest takes to 5 %; empty if it is not charted.
std::string handicap_of_uniform(const AccuracyChart& chart) {
  const auto uniform = std::find_if(chart.lines.begin(), chart.lines.end(),
                                    [](const auto& line) { return line.estimator == kSimplest; });
  const std::optional<FastestLine> fastest = fastest_to(chart, kUsualError);
  if (uniform == chart.lines.end() || !fastest || fastest->line == &*uniform) return "";
  const std::optional<LinePoint> point = at_error(*uniform, kUsualError);
  if (!point) {
    return fmt::format("; uniform sampling does not reach {} with {}", percent(kUsualError),
                       counted(uniform->points.back().samples, "sample"));
  }
  const double times = point->seconds / fastest->point.seconds;
  return fmt::format(
      "; to {} uniform sampling takes {} times as long", percent(kUsualError),
      times < 1000.0 ? format_number(times, 2) : with_thousands(static_cast<std::uint64_t>(times)));
}

std::size_t unmeasured_points(const AccuracyChart& chart) {
  std::size_t count = 0;
  for (const AccuracyLine& line : chart.lines) {
    count += static_cast<std::size_t>(std::count_if(line.points.begin(), line.points.end(),
                                                    [](const auto& p) { return !is_measured(p); }));
  }
  return count;
}

/// The line of the same points by the other kind of table: "environment B alias sobol" of
/// "environment B sobol".
const AccuracyLine* by_alias_table(const AccuracyChart& chart, const AccuracyLine& line) {
  constexpr std::string_view kMap = "environment B ";
  if (!line.estimator.starts_with(kMap)) return nullptr;
  const std::string other = fmt::format("{}alias {}", kMap, line.estimator.substr(kMap.size()));
  const auto found = std::find_if(chart.lines.begin(), chart.lines.end(),
                                  [&](const auto& l) { return l.estimator == other; });
  return found == chart.lines.end() ? nullptr : &*found;
}

}  // namespace

std::string accuracy_finding(const AccuracyChart& chart) {
  std::string text = time_to(chart, kUsualError);
  if (fastest_to(chart, kUsualError)) {
    text += fmt::format(", {}", time_to(chart, kLowError));
  }
  return text + handicap_of_uniform(chart);
}

std::string front_sentence(const AccuracyChart& chart) {
  std::string text;
  std::vector<const AccuracyLine*> named;
  for (const ChartPoint& p : pareto_front(chart)) {
    if (std::find(named.begin(), named.end(), p.line) != named.end()) continue;
    named.push_back(p.line);
    text += fmt::format("{}{} ({}, {})", text.empty() ? "" : "; ", p.line->estimator,
                        seconds_text(p.point->seconds), percent(known_error(*p.point)));
  }
  return text.empty() ? "" : fmt::format("On the front, from fast to exact: {}.", text);
}

std::string accuracy_caveats(const AccuracyChart& chart) {
  std::string text = fmt::format(
      "{}, {}, quality {}.", counted(chart.lines.size(), "estimator"),
      counted(static_cast<std::size_t>(chart.shading_points), "shading point"), chart.quality);
  if (const std::size_t missed = unmeasured_points(chart); missed > 0) {
    text += fmt::format(
        " At {} the error is carried by rare hits, too few of which were seen to measure it: the "
        "line is dashed there, and is the exact prediction, or ends where none is known.",
        counted(missed, "point"));
  }
  if (chart.is_occluded) {
    text +=
        " Something blocks the light of this receiver: look-ups in what was integrated beforehand "
        "ignore it, and are off by as much as their floor says, however exact they are elsewhere.";
  }
  return text;
}

std::string regime_finding(const MethodRegimes& regimes) {
  std::vector<std::string> winners;
  for (const MethodRegime& r : regimes.regimes) {
    winners.push_back(r.estimator.empty() ? "none" : r.estimator);
  }
  std::string text;
  for (const std::string& name : unique_names(winners)) {
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", name,
                        std::count(winners.begin(), winners.end(), name));
  }
  return fmt::format("Fastest to {} error over {} of light and roughness: {}",
                     percent(regimes.error), counted(winners.size(), "pair"), text);
}

std::string slope_finding(const AccuracyChart& chart) {
  const AccuracyLine* worst = nullptr;
  double largest = 0.0;
  std::size_t pairs = 0;
  for (const AccuracyLine& line : chart.lines) {
    const AccuracyLine* alias = by_alias_table(chart, line);
    if (alias == nullptr || !std::isfinite(line.slope) || !std::isfinite(alias->slope)) continue;
    const double loss = alias->slope - line.slope;
    if (pairs++ == 0 || loss > largest) {
      worst = &line;
      largest = loss;
    }
  }
  if (worst == nullptr) {
    return "No slopes of the same points by both kinds of table could be fitted";
  }
  const AccuracyLine& alias = *by_alias_table(chart, *worst);
  return fmt::format(
      "{} points fall with {} by the monotone table and with {} by the alias table{}",
      worst->estimator.substr(std::string_view("environment B ").size()),
      with_error(worst->slope, worst->slope_error), with_error(alias.slope, alias.slope_error),
      pairs == 1 ? "" : fmt::format(": the largest difference of {} sets", pairs));
}

}  // namespace lightproof
