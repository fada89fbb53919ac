// Convergence of every estimator, and its variance against the prediction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr std::string_view kDensityNote =
    "Variance of one sample relative to the square of the mean, by quadrature of the map, averaged "
    "over the pixels; the least one in bold. B is without variance where all of the map is seen "
    "with one weight; A draws the poles more often, and has the least where what is looked for "
    "lies there. C differs from B inside texels alone, by cot(theta) pi/H of a row: at the poles, "
    "and the less the more rows H the map has.";

Table slope_table(const std::vector<ConvergenceRecord>& records) {
  Table table("Fitted slopes", {"Estimator", "Map", "Receiver", "Material", "Slope",
                                "Standard error", "Largest N", "RMSE / mean there", "Predicted"});
  for (const ConvergenceRecord& r : records) {
    if (r.points.empty()) continue;
    const ConvergencePoint& last = r.points.back();
    table.add({text_cell(r.estimator),
               text_cell(r.map),
               text_cell(r.receiver),
               text_cell(r.material),
               number_cell(r.slope),
               number_cell(r.slope_error, 2),
               {with_thousands(last.samples), "number", ""},
               number_cell(last.rmse),
               number_cell(last.predicted)});
  }
  return table;
}

/// Of every scene the least variance is framed.
Table density_table(const std::vector<DensityVariances>& scenes) {
  std::vector<std::string> columns = {"Map", "Receiver", "Material"};
  for (const DensityInfo& density : kDensities) {
    columns.push_back(fmt::format("{}, {}", density.label, density.name));
  }
  Table table("Exact variance / mean\u00b2 of single estimates by each density", columns);
  for (const DensityVariances& p : scenes) {
    std::vector<Cell> row = {text_cell(p.scene->map), text_cell(p.scene->receiver),
                             text_cell(p.scene->material)};
    for (const double variance : p.variances) {
      row.push_back(std::isfinite(variance) ? number_cell(variance, 4)
                                            : Cell{"\u2013", "number", ""});
    }
    row[3 + p.least].css_class += " least";
    table.add(row);
  }
  return table;
}

std::string density_comparison(const std::vector<ConvergenceRecord>& records) {
  const std::vector<DensityVariances> scenes = density_variances(records);
  if (scenes.empty()) return "";
  return fmt::format("<h3>{}</h3>\n", escaped(density_finding(scenes))) +
         paragraph(kDensityNote, "note") + density_table(scenes).html();
}

Table variance_table(const std::vector<ConvergenceRecord>& records) {
  Table table("Variances", {"Estimator", "Map", "Receiver", "Material", "Measured / mean\u00b2",
                            "Predicted / mean\u00b2", "Ratio", "Standard error"});
  for (const ConvergenceRecord& r : records) {
    const bool ratio = has_ratio(r);
    table.add({text_cell(r.estimator), text_cell(r.map), text_cell(r.receiver),
               text_cell(r.material), number_cell(r.measured_variance),
               number_cell(r.predicted_variance),
               ratio ? number_cell(r.measured_variance / r.predicted_variance, 4)
                     : Cell{"\u2013", "number", ""},
               number_cell(r.variance_ratio_error, 2)});
  }
  return table;
}

/// The glyph of a Vega symbol, drawn by hand in a box of 12 by 12.
std::string glyph(const SeriesStyle& style) {
  std::string path = "M6 1A5 5 0 1 0 6 11A5 5 0 1 0 6 1Z";
  if (style.shape == "square") path = "M1.5 1.5H10.5V10.5H1.5Z";
  if (style.shape == "triangle-up") path = "M6 1L11.5 10.5H.5Z";
  if (style.shape == "triangle-down") path = "M6 11L.5 1.5H11.5Z";
  if (style.shape == "triangle-right") path = "M11 6L1.5 .5V11.5Z";
  if (style.shape == "triangle-left") path = "M1 6L10.5 .5V11.5Z";
  if (style.shape == "diamond") path = "M6 0L11 6L6 12L1 6Z";
  if (style.shape == "cross") path = "M4 1H8V4H11V8H8V11H4V8H1V4H4Z";
  return fmt::format(
      "<svg viewBox=\"0 0 12 12\" width=\"12\" height=\"12\" aria-hidden=\"true\">"
      "<path d=\"{}\" fill=\"{}\"/></svg>",
      path, style.colour);
}

std::string legend(const std::vector<ConvergenceRecord>& records) {
  std::string items;
  for (const SeriesStyle& style : estimator_styles(records)) {
    items += fmt::format("<li>{} {}</li>", glyph(style), escaped(style.name));
  }
  return "<ul class=\"legend\">" + items +
         "<li>solid: measured</li><li>dashed: predicted</li></ul>\n";
}

/// Each map is compared by the same two, if they were measured there.
std::vector<const ConvergenceRecord*> usual_rivals(std::vector<const ConvergenceRecord*> here) {
  std::vector<const ConvergenceRecord*> rivals;
  std::copy_if(here.begin(), here.end(), std::back_inserter(rivals), [](const auto* r) {
    return r->estimator == "uniform" || r->estimator == "environment B";
  });
  return rivals.size() == 2 ? rivals : here;
}

std::string small_multiples(const std::vector<ConvergenceRecord>& records) {
  const std::string scene = scene_name(records.front());
  std::vector<std::string> maps;
  for (const ConvergenceRecord& r : records) {
    if (scene_name(r) == scene) maps.push_back(r.map);
  }
  maps = unique_names(maps);
  if (maps.size() < 2) return "";
  std::string html = fmt::format("<h3>{} at once: {}</h3>\n", escaped(counted(maps.size(), "map")),
                                 escaped(scene));
  html += legend(records) + "<div class=\"multiples\">\n";
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::vector<const ConvergenceRecord*> here;
    for (const ConvergenceRecord& r : records) {
      if (scene_name(r) == scene && r.map == maps[i]) here.push_back(&r);
    }
    const std::string title = fmt::format("{}: {}", maps[i], saving_finding(usual_rivals(here)));
    const std::string text = fmt::format("RMSE against samples on {}, {}", maps[i], scene);
    html += chart_figure({fmt::format("convergence-{}", i + 1), title, text, "",
                          small_convergence_chart(records, maps[i], scene)},
                         "", true);
  }
  return html + "</div>\n";
}

constexpr std::string_view kConvergenceNote =
    "Root mean square error over pixels and independent repetitions, divided by the mean value. "
    "Dashed: what the exact variance predicts, with nothing fitted. Bars: two standard errors on "
    "either side, often smaller than the symbols.";

constexpr std::string_view kVarianceNote =
    "Every estimator of the convergence study once: its measured variance per sample divided by "
    "the variance that was computed from the map by quadrature. Bars: two standard errors on "
    "either side, so about one in twenty may miss the line at 1. Pale: ratios with a standard "
    "error "
    "above a third, which say little, and do not count in the title.";

}  // namespace

std::string convergence_section(const std::vector<ConvergenceRecord>& records) {
  std::string html = "<section id=\"convergence\">\n<h2>Convergence</h2>\n";
  if (records.empty()) {
    return html + paragraph("Convergence was not measured in this study.", "empty") +
           "</section>\n";
  }
  const auto exact = static_cast<std::size_t>(std::count_if(
      records.begin(), records.end(), [](const auto& r) { return is_all_but_exact(r); }));
  const std::vector<ChartTitle> titles = convergence_titles(records);
  std::string note = fmt::format("{} Over all scenes: {}. {}", kConvergenceNote,
                                 convergence_finding(records), prediction_finding(records));
  if (exact > 0) {
    note += fmt::format(" Not shown: {} that {} all but exact (variance below 1e-8 of mean\u00b2).",
                        counted(exact, "estimator"), exact == 1 ? "is" : "are");
  }
  const Chart chart = {"convergence-chart",
                       titles.front().title,
                       "Error of each estimator against its number of samples, measured and "
                       "predicted, for a map and receiver of your choice",
                       note,
                       convergence_chart(records),
                       titles};
  html += chart_figure(chart, collapsible("Slopes as a table", slope_table(records).html()) +
                                  download_link("convergence.csv", convergence_csv(records)));
  return html + small_multiples(records) + "</section>\n";
}

std::string variance_section(const std::vector<ConvergenceRecord>& records) {
  std::string html = "<section id=\"variance\">\n<h2>Variance</h2>\n";
  const auto without = static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(), [](const auto& r) { return !has_ratio(r); }));
  if (without == records.size()) {
    return html + paragraph("No variance was both measured and predicted in this study.", "empty") +
           "</section>\n";
  }
  std::string note(kVarianceNote);
  if (without > 0) {
    note += fmt::format(" Not shown: {} all but exact, or without a standard error.",
                        counted(without, "estimator"));
  }
  const Chart chart = {"variance-chart", variance_finding(records),
                       "Ratio of measured to predicted variance against the predicted variance",
                       note, variance_chart(records)};
  return html +
         chart_figure(chart, collapsible("Variances as a table", variance_table(records).html()) +
                                 download_link("variance.csv", variance_csv(records))) +
         density_comparison(records) + "</section>\n";
}

}  // namespace lightproof
