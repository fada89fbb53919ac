// What the report opens with: speed against accuracy; and later what follows from it.
#include <fmt/format.h>

#include <algorithm>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_blocks.h"
#include "lightproof/report/accuracy_charts.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/report/accuracy_tables.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/warp_figures.h"

namespace lightproof {
namespace {

constexpr std::string_view kHowToRead =
    "Every estimator of reflected light: how long one shading point takes, and how far it is off "
    "then (root mean square error over the points, bias included, over the mean). Left and low is "
    "good. Falling lines: more samples, less error. A single mark takes what it takes, whatever "
    "the "
    "budget: a look-up, or as many shadow rays as there are lights. A dotted line is a "
    "bias that no number of samples takes away. Thin dashes: the error that "
    "follows from exact moments, where these are known. Rings "
    "on the broad grey line: nothing is both faster and more exact by more than a tenth (the "
    "Pareto front). In colour: "
    "those, and the most efficient of every other family; the rest is grey until its family is "
    "clicked in the legend. What was prepared before the first point, tables or maps, counts by "
    "the "
    "share that the list above says. Point at a mark for its name, samples, time, set-up, memory "
    "and "
    "error. Bars: two "
    "standard errors on either side. Errors below 0.01 % and above 1000 % are drawn on the edge.";

std::vector<ChartTitle> titles_of(const std::vector<AccuracyChart>& charts) {
  const SceneChoice choice = accuracy_choice(charts);
  std::vector<ChartTitle> titles;
  for (const AccuracyChart& chart : charts) {
    titles.push_back({choice.key(scene_of(chart)), accuracy_finding(chart)});
  }
  return titles;
}

/// What belongs to the chosen scene alone.
std::string blocks_of(const std::vector<AccuracyChart>& charts) {
  const SceneChoice choice = accuracy_choice(charts);
  std::string html;
  for (const AccuracyChart& chart : charts) {
    html += choice_block(choice.key(scene_of(chart)),
                         paragraph(front_sentence(chart)) +
                             paragraph(fmt::format("{}, {}, {}: {}", chart.map, chart.receiver,
                                                   chart.material, accuracy_caveats(chart)),
                                       "note") +
                             accuracy_tables_html(chart));
  }
  return html;
}

std::string first_finding(const std::vector<AccuracyChart>& charts) {
  const auto open = std::find_if(charts.begin(), charts.end(),
                                 [](const AccuracyChart& chart) { return !chart.is_occluded; });
  return accuracy_finding(open == charts.end() ? charts.front() : *open);
}

std::string slope_figure(const std::vector<AccuracyChart>& charts) {
  const std::string spec = slope_chart(charts);
  if (spec.empty()) return "";
  const SceneChoice choice = accuracy_choice(charts);
  std::vector<ChartTitle> titles;
  for (const AccuracyChart& chart : charts) {
    titles.push_back({choice.key(scene_of(chart)), slope_finding(chart)});
  }
  return chart_figure({"slope-chart", titles.front().title,
                       "Fitted slopes of error against samples, by point set and kind of table",
                       "The slope of log error against log samples by least squares, with bars of "
                       "two standard errors. Random points fall with \u22120.5 (dashed); points "
                       "that are spread evenly fall faster where the way from the unit square to "
                       "directions keeps neighbours together, as a monotone table does. An alias "
                       "table throws half of every texel's share elsewhere, and breaks that.",
                       spec, titles},
                      "");
}

std::string memory_figure(const std::vector<AccuracyChart>& charts) {
  const std::string spec = memory_chart(charts);
  if (spec.empty()) return "";
  const SceneChoice choice = accuracy_choice(charts);
  std::vector<ChartTitle> titles;
  for (const AccuracyChart& chart : charts) {
    titles.push_back({choice.key(scene_of(chart)), memory_finding(chart)});
  }
  return chart_figure({"memory-chart", titles.front().title,
                       "Error at 64 samples against the memory that an estimator keeps",
                       "Every estimator that keeps a table or a map: its error at 64 samples, or "
                       "what it is if samples are without meaning, with bars of two standard "
                       "errors; rings are what exact moments predict. Tables of the map come "
                       "reduced to 1/2 to 1/16 of its sides, as half floats and as bytes: less "
                       "memory costs variance, no bias.",
                       spec, titles},
                      "");
}

Table regime_table(const MethodRegimes& regimes) {
  Table table("Which method wins where", {"Roughness", "Effective fraction", "Fastest", "Time",
                                          "Fastest without bias", "Time"});
  const auto time = [](const std::string& estimator, double seconds) {
    return Cell{estimator.empty() ? "\u2013" : seconds_text(seconds), "number", ""};
  };
  for (const MethodRegime& r : regimes.regimes) {
    table.add({number_cell(r.roughness, 2),
               {percent(r.effective_fraction), "number", ""},
               text_cell(r.estimator),
               time(r.estimator, r.seconds),
               text_cell(r.unbiased_estimator),
               time(r.unbiased_estimator, r.unbiased_seconds)});
  }
  return table;
}

std::string regime_figure(const MethodRegimes& regimes) {
  if (regimes.regimes.empty()) return "";
  const std::string note = fmt::format(
      "A sphere of GGX under one soft light that fills so much of the sphere: the fastest "
      "estimator "
      "to {} error, and its time for a shading point, without set-up.{}",
      percent(regimes.error),
      regimes.origin.empty() ? "" : fmt::format(" Measured on {}.", regimes.origin));
  return chart_figure(
      {"regime-chart", regime_finding(regimes),
       "The fastest estimator over roughness and the width of the light", note,
       regime_chart(regimes)},
      collapsible("Which method wins where, as a table", regime_table(regimes).html()) +
          download_link("method-regimes.csv", method_regimes_csv(regimes)));
}

}  // namespace

std::string accuracy_section(const std::vector<AccuracyChart>& charts) {
  if (charts.empty()) return "";
  const Chart chart = {"accuracy-chart",
                       first_finding(charts),
                       "Error of every estimator against its time, for a map, receiver and "
                       "material of your choice",
                       std::string(kHowToRead),
                       accuracy_chart(charts),
                       titles_of(charts)};
  return "<section id=\"accuracy\">\n<h2>Speed against accuracy</h2>\n" +
         chart_figure(chart,
                      blocks_of(charts) + download_link("accuracy.csv", accuracy_csv(charts))) +
         "</section>\n";
}

std::string methods_section(const StudyResult& study) {
  std::string html = "<section id=\"methods\">\n<h2>Methods</h2>\n";
  if (study.accuracy.empty()) {
    return html +
           paragraph(
               "Speed was not charted against accuracy in this study: leave out "
               "`--no-accuracy`.",
               "empty") +
           "</section>\n";
  }
  return html + "<h3>The fastest to 5\u00a0% error</h3>\n" + winners_table_html(study.accuracy) +
         samples_table_html(study.accuracy) + regime_figure(study.method_regimes) +
         memory_figure(study.accuracy) + slope_figure(study.accuracy) + warp_figures(study.warps) +
         "</section>\n";
}

}  // namespace lightproof
