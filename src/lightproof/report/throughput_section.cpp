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

std::string tables_table(const std::vector<TableRecord>& records) {
  Table table("Tables", {"Sampler", "Map", "Size", "ns per sample", "Times std::upper_bound",
                         "Share of the limit", "Bytes per texel", "Worst texel's error"});
  for (const TableRecord& r : records) {
    table.add({text_cell(r.sampler),
               text_cell(r.map),
               {extent_text(r.extent), "number", ""},
               number_cell(r.ns_per_sample),
               r.times_baseline > 0.0 ? number_cell(r.times_baseline) : text_cell("1"),
               r.share_of_limit > 0.0 ? number_cell(r.share_of_limit) : text_cell("\u2013"),
               number_cell(r.bytes_per_texel),
               number_cell(r.worst_texel_error)});
  }
  return table.html();
}

constexpr std::string_view kTablesNote =
    "Batches of samples on one thread, random numbers included. The error is the largest relative "
    "difference between the probability with which a texel is drawn and its share of the light; "
    "samplers return the probability that they draw with, so the error costs variance, no bias. "
    "Along the dashed line, from ring to ring, nothing gets better in one way without getting "
    "worse "
    "in the other.";

/// The costs that are held against speed.
std::string table_figures(const std::vector<TableRecord>& tables) {
  if (tables.empty()) return "";
  const Chart accuracy = {
      "table-accuracy-chart",
      tables_finding(tables, &TableRecord::worst_texel_error, "more accurate"),
      "Time per sample of each sampler against the worst relative error of a texel",
      std::string(kTablesNote),
      table_chart(tables, &TableRecord::worst_texel_error, "worst texel's relative error (log)")};
  const Chart memory = {
      "table-memory-chart", tables_finding(tables, &TableRecord::bytes_per_texel, "smaller"),
      "Time per sample of each sampler against the bytes of its table per texel", "",
      table_chart(tables, &TableRecord::bytes_per_texel,
                  "size of the table (bytes per texel, log)")};
  return chart_figure(accuracy, "") +
         chart_figure(memory, collapsible("Tables as a table", tables_table(tables)) +
                                  download_link("tables.csv", tables_csv(tables)));
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
         table_figures(study.tables) + "</section>\n";
}

}  // namespace lightproof
