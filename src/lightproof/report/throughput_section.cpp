// Time per sample and time to build against the size of the map; what the tables cost.
#include <fmt/format.h>

#include <algorithm>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/directions_figure.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/names.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

std::string throughput_table(const std::vector<ThroughputRecord>& records) {
  Table table("Throughput", {"Sampler", "Map", "Size", "Median, ns", "Fastest, ns", "Slowest, ns",
                             "Table, bytes", "Build, ms", "Machine"});
  for (const ThroughputRecord& r : records) {
    table.add({text_cell(r.sampler),
               text_cell(r.map),
               {extent_text(r.extent), "number", ""},
               number_cell(r.ns_per_sample),
               number_cell(r.ns_low),
               number_cell(r.ns_high),
               number_cell(r.table_bytes),
               number_cell(r.build_ms),
               text_cell(machine_words(r.wall_per_cpu))});
  }
  return table.html();
}

Cell leaving_cell(const std::optional<Extent>& extent, const std::optional<double>& bytes) {
  if (!bytes) return text_cell("not known");
  return text_cell(extent ? extent_text(*extent) : "no size");
}

/// "0.02, from 1024×512 on 0.31".
Cell breakpoints_cell(const std::optional<SegmentedGrowth>& breakpoints) {
  if (!breakpoints) return text_cell("none");
  std::string text = format_number(breakpoints->exponent_before, 2);
  for (const GrowthBreakpoint& breakpoint : breakpoints->breakpoints) {
    text += fmt::format(", from {} on {}", extent_text(breakpoint.extent),
                        format_number(breakpoint.exponent_after, 2));
  }
  return {text, "detail", fmt::format("p = {}", format_number(breakpoints->p_value, 2))};
}

constexpr std::string_view kGrowthNote =
    "A sampler whose time follows its steps takes the same time for each; the table has the "
    "fastest step and the slowest. What is left is the memory: once a table outgrows a cache, a "
    "step of the search waits for it, while a scan reads ahead. The exponent is that of the whole "
    "time against width plus height, by least squares on logarithms. Where the sizes of the caches "
    "are known, a table outgrows one at the smallest measured map on which it is larger. "
    "Breakpoints are measured: a line with one or "
    "two of them that fits the time of a step so much better than a straight one that straight "
    "ones with random errors would hardly seem to bend as clearly: where all samplers are "
    "straight, any of them has a breakpoint with a probability of at most 1 % (Holm's procedure "
    "over all samplers). At least two sizes lie on either side of a breakpoint; few sizes, or much "
    "scatter, show none.";

std::string growth_table(const std::vector<GrowthFit>& growth, const CacheSizes& caches) {
  if (growth.empty()) return "";
  Table table("Fitted growth",
              {"Sampler", "Steps", "Fastest, ns", "Slowest, ns", "Exponent", "Outgrows L2",
               "Outgrows L3", "Exponents of a step, and its breakpoints"});
  for (const GrowthFit& fit : growth) {
    const StepRange range = step_range(fit);
    table.add({text_cell(fit.sampler),
               text_cell(fit.model),
               number_cell(range.fastest.ns),
               number_cell(range.slowest.ns),
               {with_error(fit.exponent, fit.exponent_error), "number", ""},
               leaving_cell(fit.leaves_l2, caches.l2),
               leaving_cell(fit.leaves_l3, caches.l3),
               breakpoints_cell(fit.segmented)});
  }
  return "<h4>" + escaped(growth_finding(growth)) + "</h4>\n" +
         paragraph(caches_finding(growth, caches) + breakpoints_finding(growth)) +
         paragraph(kGrowthNote, "note") + table.html() +
         download_link("growth.csv", growth_csv(growth));
}

/// The smallest and the largest map that a sampler was built on.
struct BuildRange {
  const ThroughputRecord* smallest = nullptr;
  const ThroughputRecord* largest = nullptr;
};

BuildRange build_range(const std::string& sampler, const std::vector<ThroughputRecord>& records) {
  BuildRange range;
  for (const ThroughputRecord& r : records) {
    if (r.sampler != sampler) continue;
    const std::size_t size = r.extent.count();
    if (!range.smallest || size < range.smallest->extent.count()) range.smallest = &r;
    if (!range.largest || size > range.largest->extent.count()) range.largest = &r;
  }
  return range;
}

std::string build_table(const StudyResult& study) {
  Table table("Building", {"Sampler", "Exponent of S \u00d7 T", "Smallest map", "ms", "Largest map",
                           "ms", "ns per texel", "Table"});
  for (const GrowthFit& fit : study.growth) {
    const auto [smallest, largest] = build_range(fit.sampler, study.throughput);
    if (!fit.build_exponent || largest == nullptr) continue;
    const double texels = static_cast<double>(largest->extent.count());
    table.add({text_cell(fit.sampler),
               {with_error(fit.build_exponent->value, fit.build_exponent->error), "number", ""},
               {extent_text(smallest->extent), "number", ""},
               number_cell(smallest->build_ms),
               {extent_text(largest->extent), "number", ""},
               number_cell(largest->build_ms),
               number_cell(1e6 * largest->build_ms / texels),
               {bytes_text(largest->table_bytes), "number", ""}});
  }
  return table.html();
}

constexpr std::string_view kBuildNote =
    "Median of at least three builds for each size, on all threads, from a map that lies in "
    "memory to a table that is ready, with the time that it takes to get the memory. A build reads "
    "the map from end to end, so an exponent near 1 is to be expected; on small maps starting the "
    "threads takes its share. The exponent is fitted by least squares on logarithms, and its "
    "standard error comes from the scatter about the line.";

std::string build_block(const StudyResult& study) {
  const bool was_measured = std::any_of(study.throughput.begin(), study.throughput.end(),
                                        [](const ThroughputRecord& r) { return r.build_ms > 0.0; });
  if (!was_measured) return "";
  return collapsible("Time to build: " + build_finding(study),
                     paragraph(kBuildNote, "note") + build_table(study)) +
         download_link("build.csv", build_csv(study.throughput));
}

std::string tables_table(const std::vector<TableRecord>& records) {
  Table table("Tables",
              {"Sampler", "Map", "Size", "ns per sample", "Times std::upper_bound",
               "Share of the limit", "Bytes per texel", "Worst texel's error", "Machine"});
  for (const TableRecord& r : records) {
    table.add({text_cell(r.sampler),
               text_cell(r.map),
               {extent_text(r.extent), "number", ""},
               number_cell(r.ns_per_sample),
               r.times_baseline > 0.0 ? number_cell(r.times_baseline) : text_cell("1"),
               r.share_of_limit > 0.0 ? number_cell(r.share_of_limit) : text_cell("\u2013"),
               number_cell(r.bytes_per_texel),
               number_cell(r.worst_texel_error),
               text_cell(machine_words(r.wall_per_cpu))});
  }
  return table.html();
}

constexpr std::string_view kTablesNote =
    "Texture-space density A, which takes tables alone: what B and C add is in the charts of "
    "directions. Batches of samples on one thread, random numbers included. The error, which the "
    "size of a "
    "mark "
    "tells, is the largest relative difference between the probability with which a texel is drawn "
    "and its share of the light; samplers return the probability that they draw with, so the error "
    "costs variance, no bias. Rings: nothing is as fast, as small and as accurate at once.";

/// What tables cost in memory and accuracy, against speed.
std::string table_figure(const std::vector<TableRecord>& tables) {
  if (tables.empty()) return "";
  const Chart chart = {"table-chart", tables_finding(tables),
                       "Time per sample of each sampler against the bytes of its table per texel, "
                       "with the worst relative error of a texel",
                       std::string(kTablesNote), table_chart(tables)};
  return chart_figure(chart, collapsible("Tables as a table", tables_table(tables)) +
                                 download_link("tables.csv", tables_csv(tables)));
}

constexpr std::string_view kNote =
    "Positions under the texture-space density A, one at a time. Median over the benchmark's "
    "repetitions; bars reach from the fastest to the slowest. "
    "The legend gives the exponent of width S plus height T that fits the time; a click on it "
    "shows "
    "a sampler, at first the fastest, the slowest and the binary search. ";
constexpr std::string_view kFrameNote =
    "Frames mark, on each line, the first map whose table is larger than a cache, and where the "
    "growth of the time of a step changes measurably.";
constexpr std::string_view kNoCacheNote =
    "This machine does not tell the sizes of its caches, so nothing is marked where a table "
    "outgrows one; frames mark where the growth of the time of a step changes measurably.";

bool knows_caches(const CacheSizes& caches) { return caches.l2 || caches.l3; }

constexpr std::string_view kMissing =
    "Throughput was not measured in this study. Build the benchmark program (LIGHTPROOF_BENCH, on "
    "by default), run the study again with it, on a machine with nothing else to do, and this "
    "section will show the time per sample of every sampler against the size of the map.";

}  // namespace

std::string throughput_section(const StudyResult& study) {
  std::string html = "<section id=\"throughput\">\n<h2>Throughput</h2>\n";
  if (study.throughput.empty()) return html + paragraph(kMissing, "empty") + "</section>\n";
  const Chart chart = {
      "throughput-chart", throughput_finding(study),
      "Time per sample of each sampler against the size of the map",
      fmt::format("{}{}", kNote, knows_caches(study.caches) ? kFrameNote : kNoCacheNote),
      throughput_chart(study)};
  if (!study.throughput_origin.empty()) {
    html += paragraph("Measured: " + study.throughput_origin + ".");
  }
  return html +
         chart_figure(chart, collapsible("Times as a table", throughput_table(study.throughput)) +
                                 download_link("throughput.csv", throughput_csv(study.throughput)) +
                                 growth_table(study.growth, study.caches)) +
         build_block(study) + table_figure(study.tables) + directions_figure(study.directions) +
         "</section>\n";
}

}  // namespace lightproof
