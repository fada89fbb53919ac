#include "lightproof/report/accuracy_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr std::array<double, 2> kErrors = {kUsualError, 0.01};
constexpr std::array<double, 4> kTimes = {1e-6, 1e-5, 1e-4, 1e-3};

using Lines = std::vector<const AccuracyLine*>;

Cell none_cell(std::string why) { return {"\u2013", "number", std::move(why)}; }

Cell time_cell(double seconds) { return {seconds_text(seconds), "number", ""}; }

Cell percent_cell(double fraction) { return {percent(fraction), "number", ""}; }

/// Samples have no meaning to an estimator of one point.
Cell samples_cell(const AccuracyLine& line, const std::optional<LinePoint>& point) {
  if (!point) return none_cell("not reached within what was measured");
  if (line.points.size() == 1) return {"fixed cost", "number", "its budget is without meaning"};
  return {with_thousands(whole_samples(*point)), "number", ""};
}

double time_to(const AccuracyLine& line, double error) {
  const std::optional<LinePoint> point = at_error(line, error);
  return point ? point->seconds : HUGE_VAL;
}

/// The fastest to 5 % first; those that do not get there last, as they were.
Lines by_time(const AccuracyChart& chart) {
  Lines lines;
  for (const AccuracyLine& line : chart.lines) lines.push_back(&line);
  std::stable_sort(lines.begin(), lines.end(), [](const auto* a, const auto* b) {
    return time_to(*a, kUsualError) < time_to(*b, kUsualError);
  });
  return lines;
}

Table equal_error_table(const AccuracyChart& chart) {
  std::vector<std::string> columns = {"Estimator", "Family"};
  for (const double error : kErrors) {
    columns.push_back("Time to " + percent(error));
    columns.push_back("Samples to " + percent(error));
  }
  columns.emplace_back("1 / (variance \u00d7 time), 1/s");
  Table table("At equal error", columns);
  for (const AccuracyLine* line : by_time(chart)) {
    std::vector<Cell> row = {text_cell(line->estimator),
                             text_cell(std::string(to_string(line->family)))};
    for (const double error : kErrors) {
      const std::optional<LinePoint> point = at_error(*line, error);
      row.push_back(point ? time_cell(point->seconds) : none_cell("not reached"));
      row.push_back(samples_cell(*line, point));
    }
    row.push_back(line->is_biased ? none_cell("biased: its error is not variance alone")
                                  : number_cell(efficiency(*line)));
    table.add(row);
  }
  return table;
}

/// What no number of samples takes away.
Cell floor_cell(const AccuracyLine& line) {
  if (!line.is_biased) return none_cell("unbiased");
  return line.floor > 0.0 ? percent_cell(line.floor)
                          : none_cell("none: the bias vanishes with more samples");
}

Table equal_time_table(const AccuracyChart& chart) {
  std::vector<std::string> columns = {"Estimator", "Family"};
  for (const double seconds : kTimes) columns.push_back("RMSE / mean in " + seconds_text(seconds));
  Table table("At equal time", columns);
  for (const AccuracyLine* line : by_time(chart)) {
    std::vector<Cell> row = {text_cell(line->estimator),
                             text_cell(std::string(to_string(line->family)))};
    for (const double seconds : kTimes) {
      const std::optional<LinePoint> point = at_time(*line, seconds);
      row.push_back(point ? percent_cell(point->error)
                          : none_cell("takes longer, or was not measured for so long"));
    }
    table.add(row);
  }
  return table;
}

Table set_up_table(const AccuracyChart& chart) {
  Table table(
      "Set-up, memory, rate and bias",
      {"Estimator", "Family", "Set-up", "Memory beside the map", "Slope of error over N", "Floor"});
  for (const AccuracyLine& line : chart.lines) {
    table.add({text_cell(line.estimator),
               text_cell(std::string(to_string(line.family))),
               time_cell(line.set_up_seconds),
               {bytes_text(static_cast<double>(line.bytes)), "number", ""},
               std::isfinite(line.slope)
                   ? Cell{with_error(line.slope, line.slope_error), "number", ""}
                   : none_cell("not fitted"),
               floor_cell(line)});
  }
  return table;
}

std::string left_out_html(const AccuracyChart& chart) {
  if (chart.left_out.empty()) return "";
  Table table("Left out", {"Estimator", "Why"});
  for (const LeftOutEstimator& r : chart.left_out) {
    table.add({text_cell(r.estimator), {r.reason, "detail", ""}});
  }
  return collapsible(
      fmt::format("{} left out, and why", counted(chart.left_out.size(), "estimator")),
      table.html());
}

/// Rows or columns in the order of their first appearance.
template <class Name>
std::vector<std::string> names_of(const std::vector<AccuracyChart>& charts, const Name& name) {
  std::vector<std::string> names;
  for (const AccuracyChart& chart : charts) names.push_back(name(chart));
  return unique_names(names);
}

std::string scene_of(const AccuracyChart& chart) { return chart.receiver + ", " + chart.material; }

const AccuracyChart* chart_at(const std::vector<AccuracyChart>& charts, const std::string& map,
                              const std::string& scene) {
  const auto found = std::find_if(charts.begin(), charts.end(), [&](const AccuracyChart& chart) {
    return chart.map == map && scene_of(chart) == scene;
  });
  return found == charts.end() ? nullptr : &*found;
}

Cell winner_cell(const AccuracyChart* chart) {
  if (chart == nullptr) return {"\u2013 not run", "absent", ""};
  const std::optional<FastestLine> fastest = fastest_to(*chart, kUsualError);
  if (!fastest) return {"none", "", "no estimator reaches the error"};
  return {fmt::format("{}, {}", fastest->line->estimator, seconds_text(fastest->point.seconds)),
          "detail", ""};
}

const AccuracyLine* line_of(const AccuracyChart& chart, const std::string& estimator) {
  const auto found =
      std::find_if(chart.lines.begin(), chart.lines.end(),
                   [&](const AccuracyLine& line) { return line.estimator == estimator; });
  return found == chart.lines.end() ? nullptr : &*found;
}

std::vector<std::string> estimators_of(const std::vector<AccuracyChart>& charts) {
  std::vector<std::string> names;
  for (const AccuracyChart& chart : charts) {
    for (const AccuracyLine& line : chart.lines) names.push_back(line.estimator);
  }
  return unique_names(names);
}

}  // namespace

std::string accuracy_tables_html(const AccuracyChart& chart) {
  return collapsible("At equal error: time and samples to 5 % and 1 %, and efficiency",
                     equal_error_table(chart).html()) +
         collapsible("At equal time: the error in 1 \u00b5s to 1 ms",
                     equal_time_table(chart).html()) +
         collapsible("Set-up time, memory, slope and bias", set_up_table(chart).html()) +
         left_out_html(chart);
}

std::string samples_table_html(const std::vector<AccuracyChart>& charts) {
  std::vector<std::string> columns = {"Estimator"};
  for (const AccuracyChart& chart : charts) {
    columns.push_back(fmt::format("{}, {}", chart.map, scene_of(chart)));
  }
  Table table("Samples to 5 % error", columns);
  for (const std::string& estimator : estimators_of(charts)) {
    std::vector<Cell> row = {text_cell(estimator)};
    for (const AccuracyChart& chart : charts) {
      const AccuracyLine* line = line_of(chart, estimator);
      row.push_back(line == nullptr ? none_cell("left out")
                                    : samples_cell(*line, at_error(*line, kUsualError)));
    }
    table.add(row);
  }
  return collapsible("Samples to 5 % error, for each estimator and map", table.html());
}

std::string winners_table_html(const std::vector<AccuracyChart>& charts) {
  const std::vector<std::string> maps =
      names_of(charts, [](const AccuracyChart& chart) { return chart.map; });
  std::vector<std::string> columns = {"Receiver, material"};
  columns.insert(columns.end(), maps.begin(), maps.end());
  Table table("The fastest to 5 % error", columns);
  for (const std::string& scene : names_of(charts, scene_of)) {
    std::vector<Cell> row = {text_cell(scene)};
    for (const std::string& map : maps) row.push_back(winner_cell(chart_at(charts, map, scene)));
    table.add(row);
  }
  return table.html();
}

}  // namespace lightproof
