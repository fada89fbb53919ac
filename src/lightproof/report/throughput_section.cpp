// Time per sample against the size of the map.
#include <fmt/format.h>

#include "lightproof/report/charts.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/html.h"
#include "lightproof/report/numbers.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

std::string throughput_table(const std::vector<ThroughputRecord>& records) {
  Table table("Throughput", {"Sampler", "Map", "Size", "Median, ns", "Fastest, ns", "Slowest, ns",
                             "Table, bytes", "Build, ms"});
  for (const ThroughputRecord& r : records) {
    table.add({text_cell(r.sampler),
               text_cell(r.map),
               {extent_text(r.extent), "number", ""},
               number_cell(r.ns_per_sample),
               number_cell(r.ns_low),
               number_cell(r.ns_high),
               number_cell(r.table_bytes),
               number_cell(r.build_ms)});
  }
  return table.html();
}

std::string growth_table(const std::vector<GrowthFit>& growth) {
  if (growth.empty()) return "";
  Table table("Fitted growth", {"Sampler", "Steps of a sample", "Fastest step, ns",
                                "Slowest step, ns", "Exponent of S + T"});
  for (const GrowthFit& fit : growth) {
    const StepRange range = step_range(fit);
    table.add({text_cell(fit.sampler),
               text_cell(fit.model),
               number_cell(range.fastest.ns),
               number_cell(range.slowest.ns),
               {with_error(fit.exponent, fit.exponent_error), "number", ""}});
  }
  return "<h4>" + escaped(growth_finding(growth)) + "</h4>\n" +
         paragraph(
             "A sampler whose time follows its steps takes the same time for each. What is left "
             "is the memory: once a table outgrows a cache, a step of the search waits for it, "
             "while a scan reads ahead. The exponent is that of the whole time against width plus "
             "height, by least squares on logarithms.",
             "note") +
         table.html();
}

constexpr std::string_view kNote =
    "Median over the benchmark's repetitions; bars reach from the fastest to the slowest. "
    "The legend gives how many steps a sample takes on a map of width S and height T.";

constexpr std::string_view kMissing =
    "Throughput was not measured in this study. Build the benchmark program (LIGHTPROOF_BENCH, on "
    "by default), run the study again with it, on a machine with nothing else to do, and this "
    "section will show the time per sample of every sampler against the size of the map.";

}  // namespace

std::string throughput_section(const StudyResult& study) {
  std::string html = "<section id=\"throughput\">\n<h2>Throughput</h2>\n";
  if (study.throughput.empty()) return html + paragraph(kMissing, "empty") + "</section>\n";
  const Chart chart = {"throughput-chart", throughput_finding(study),
                       "Time per sample of each sampler against the size of the map",
                       std::string(kNote), throughput_chart(study.throughput, study.growth)};
  return html +
         chart_figure(chart, collapsible("Times as a table", throughput_table(study.throughput)) +
                                 download_link("throughput.csv", throughput_csv(study.throughput)) +
                                 growth_table(study.growth)) +
         "</section>\n";
}

}  // namespace lightproof
