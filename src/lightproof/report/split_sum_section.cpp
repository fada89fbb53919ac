// What the split sum gets wrong on each map.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr std::string_view kNote =
    "A GGX surface (Smith's height-correlated masking, Schlick's Fresnel factor) under each map: "
    "the prefiltered map times F0 A + B, both exact, against the integral of the map and the "
    "surface's own reflection. Each number is a root mean square over all orientations of surface "
    "and view in the map, over the mean of the exact radiance, in luminance; it was computed in "
    "spherical harmonics up to degree 160, and nothing is sampled: where finer detail may add to "
    "it, "
    "a \u2265 stands before it and the table has a bound. Levels and tables of an engine come on "
    "top. A small bright sun makes large numbers: its highlight has another shape, and at grazing "
    "views another place.";

std::string table_of(const std::vector<SplitSumRecord>& records) {
  Table table("Error of the split sum", {"Map", "F0", "Roughness", "View angle (\u00b0)",
                                         "RMS error / mean", "With finer detail, at most"});
  for (const SplitSumRecord& r : records) {
    table.add({text_cell(r.map), number_cell(r.normal_reflectance), number_cell(r.roughness),
               number_cell(view_degrees(r)), number_cell(r.rmse),
               number_cell(std::hypot(r.rmse, r.left_out))});
  }
  return table.html();
}

std::string small_multiples(const std::vector<SplitSumRecord>& records) {
  const double f0 = records.front().normal_reflectance;
  std::vector<std::string> maps;
  for (const SplitSumRecord& r : records) maps.push_back(r.map);
  maps = unique_names(maps);
  if (maps.size() < 2) return "";
  std::string html = fmt::format("<h3>{} at once: F0 = {}</h3>\n<div class=\"multiples\">\n",
                                 escaped(counted(maps.size(), "map")), plain_number(f0));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::vector<SplitSumRecord> here;
    for (const SplitSumRecord& r : records) {
      if (r.map != maps[i] || r.normal_reflectance != f0) continue;
      here.push_back(r);
    }
    const auto most = std::max_element(
        here.begin(), here.end(),
        [](const SplitSumRecord& a, const SplitSumRecord& b) { return a.rmse < b.rmse; });
    html += chart_figure(
        {fmt::format("split-sum-{}", i + 1),
         fmt::format("{}: up to {}", maps[i], percent_text(most->rmse)),
         fmt::format("Error of the split sum on {}, over roughness and view angle", maps[i]), "",
         small_split_sum_chart(here)},
        "", true);
  }
  return html + "</div>\n";
}

}  // namespace

std::string split_sum_section(const std::vector<SplitSumRecord>& records) {
  std::string html = "<section id=\"split-sum\">\n<h2>Split sum</h2>\n";
  if (records.empty()) {
    return html + paragraph("The split sum's error was not computed in this study.", "empty") +
           "</section>\n";
  }
  const Chart chart = {
      "split-sum-chart", split_sum_finding(records),
      "Heat map of the error of the split sum over roughness and view angle, for a "
      "map and a reflectance of your choice",
      std::string(kNote), split_sum_chart(records)};
  html += chart_figure(chart, collapsible("Errors as a table", table_of(records)) +
                                  download_link("split_sum.csv", split_sum_csv(records)));
  return html + small_multiples(records) + "</section>\n";
}

}  // namespace lightproof
