#include "lightproof/report/directions_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/core/machine.h"
#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/names.h"

namespace lightproof {
namespace {

/// The size at which samplers are compared first, or that which is nearest to it.
constexpr std::size_t kUsualTexels = std::size_t{2048} * 1024;

/// Whether a record is of a sampler, not of what samplers are compared with.
bool is_sampler(const DirectionRecord& record) { return record.times_baseline > 0.0; }

std::vector<DirectionRecord> of_order(const std::vector<DirectionRecord>& records, DrawOrder order,
                                      Extent extent) {
  std::vector<DirectionRecord> chosen;
  std::copy_if(records.begin(), records.end(), std::back_inserter(chosen),
               [&](const DirectionRecord& r) {
                 return r.order == order && r.extent == extent && is_sampler(r);
               });
  return chosen;
}

/// The usual size of a map and the largest one, of those that were measured.
std::vector<Extent> shown_sizes(const std::vector<DirectionRecord>& records) {
  const auto is_farther = [](const DirectionRecord& a, const DirectionRecord& b) {
    const auto factor = [](const DirectionRecord& r) {
      return std::abs(std::log(static_cast<double>(r.extent.count()) / kUsualTexels));
    };
    return factor(a) < factor(b);
  };
  const auto is_smaller = [](const DirectionRecord& a, const DirectionRecord& b) {
    return a.extent.count() < b.extent.count();
  };
  const Extent usual = std::ranges::min_element(records, is_farther)->extent;
  const Extent largest = std::ranges::max_element(records, is_smaller)->extent;
  return usual == largest ? std::vector{usual} : std::vector{usual, largest};
}

const DirectionRecord* fastest(const std::vector<DirectionRecord>& records) {
  const auto found = std::min_element(records.begin(), records.end(),
                                      [](const DirectionRecord& a, const DirectionRecord& b) {
                                        return a.ns_per_sample < b.ns_per_sample;
                                      });
  return found == records.end() ? nullptr : &*found;
}

std::string_view short_words(DrawOrder order) {
  return order == DrawOrder::fused ? "in batches" : describe(order).words;
}

/// "B takes 1.12 and C 1.01 times as long as A": of one sampler, in one order.
std::string density_ratios(const std::vector<DirectionRecord>& records,
                           const std::string& sampler) {
  const auto time_of = [&](std::string_view density) {
    for (const DirectionRecord& r : records) {
      if (r.sampler == sampler && r.density == density) return r.ns_per_sample;
    }
    return 0.0;
  };
  const double a = time_of("A");
  if (!(a > 0.0) || !(time_of("B") > 0.0) || !(time_of("C") > 0.0)) return "";
  return fmt::format("; of {}, B takes {} and C {} times as long as A", sampler,
                     format_number(time_of("B") / a, 3), format_number(time_of("C") / a, 3));
}

constexpr std::string_view kNote =
    "A renderer asks for a direction with its density per steradian. Under the solid-angle density "
    "B "
    "the cosine of the angle from the axis is uniform inside a row, so that a direction takes a "
    "square "
    "root and no inverse trigonometry; A and C take a sine and a cosine instead. The usual way is "
    "std::upper_bound over sums in float, with the library's sine and cosine, under the same "
    "density. One at a time means points that are given, and no other work between two samples; "
    "begun ahead, that the memory is asked for a sample's texels eight samples before it is "
    "finished. "
    "Times are of one thread, in processor time; a hollow mark met a busy machine.";

/// The marks of a quiet machine, filled, or of a busy one.
Json marks(const char* machine, bool filled, const std::vector<SeriesStyle>& styles) {
  const Json legend = {{"title", "density"}, {"columns", 3}};
  Json layer = {{"transform", {{{"filter", fmt::format("datum.busy === '{}'", machine)}}}},
                {"mark", {{"type", "point"}, {"filled", filled}, {"size", 70}, {"opacity", 1}}},
                {"encoding",
                 {{"color", series(styles, &SeriesStyle::colour, legend)},
                  {"shape", series(styles, &SeriesStyle::shape, legend)},
                  {"tooltip",
                   {tooltip("series", "sampler", ""), tooltip("density", "density", ""),
                    tooltip("order", "drawn", ""), tooltip("ns", "ns per direction", ".3~g"),
                    tooltip("baseline", "times as fast as the usual way", ""),
                    tooltip("limit", "share of the limit's speed", ""),
                    tooltip("wall", "wall over processor time", ".3~g")}}}}};
  // The styles are of densities: the field that they are chosen by is that one.
  for (const char* channel : {"color", "shape"}) layer["encoding"][channel]["field"] = "density";
  return layer;
}

}  // namespace

std::string directions_finding(const std::vector<DirectionRecord>& records, Extent extent) {
  const std::vector<DirectionRecord> batches = of_order(records, DrawOrder::fused, extent);
  const DirectionRecord* const best = fastest(batches);
  if (best == nullptr) return "Time per direction";
  std::string text =
      fmt::format("On {} in batches {} draws a direction {} times as fast as the usual way",
                  extent_text(extent), best->sampler, format_number(best->times_baseline, 2));
  const std::vector<DirectionRecord> singles = of_order(records, DrawOrder::scalar, extent);
  if (const DirectionRecord* const single = fastest(singles)) {
    text += fmt::format(", one at a time {} {} times", single->sampler,
                        format_number(single->times_baseline, 2));
  }
  return text + density_ratios(batches, best->sampler);
}

std::string directions_chart(const std::vector<DirectionRecord>& records, Extent extent) {
  Json rows = Json::array();
  LogRange times;
  for (const DirectionRecord& r : records) {
    if (!(r.extent == extent) || !drawable(r.ns_per_sample)) continue;
    times.add(r.ns_per_sample);
    rows.push_back({{"series", fmt::format("{}, {}", r.sampler, short_words(r.order))},
                    {"density", r.density},
                    {"order", describe(r.order).words},
                    {"busy", r.wall_per_cpu > kBusyRatio ? "busy" : "quiet"},
                    {"wall", rounded(r.wall_per_cpu)},
                    {"ns", rounded(r.ns_per_sample)},
                    {"baseline", r.times_baseline > 0.0 ? format_number(r.times_baseline, 3) : "1"},
                    {"limit", r.share_of_limit > 0.0 ? format_number(r.share_of_limit, 2) : "–"}});
  }
  const std::vector<SeriesStyle> styles = series_styles({"A", "B", "C"});
  Json x = quantity("ns", "time per direction (ns, log)", "log");
  x["axis"] = log_axis(times.low, times.high);
  x["scale"]["padding"] = 16;
  Json chart = base_chart(320);
  chart["data"] = {{"values", rows}};
  chart["encoding"] = {{"x", x},
                       {"y",
                        {{"field", "series"},
                         {"type", "nominal"},
                         {"title", nullptr},
                         {"sort", {{"field", "ns"}, {"op", "min"}}}}}};
  chart["layer"] = {marks("quiet", true, styles), marks("busy", false, styles)};
  return text_of(chart);
}

std::string directions_figure(const std::vector<DirectionRecord>& records) {
  if (records.empty()) return "";
  Table table("Directions", {"Sampler", "Map", "Size", "Density", "Drawn", "ns per direction",
                             "Times the usual way", "Share of the limit", "Machine"});
  for (const DirectionRecord& r : records) {
    table.add({text_cell(r.sampler),
               text_cell(r.map),
               {extent_text(r.extent), "number", ""},
               text_cell(r.density),
               text_cell(std::string(describe(r.order).words)),
               number_cell(r.ns_per_sample),
               is_sampler(r) ? number_cell(r.times_baseline) : text_cell("–"),
               r.share_of_limit > 0.0 ? number_cell(r.share_of_limit) : text_cell("–"),
               text_cell(machine_words(r.wall_per_cpu))});
  }
  std::string html;
  const std::vector<Extent> sizes = shown_sizes(records);
  for (const Extent extent : sizes) {
    const bool is_last = extent == sizes.back();
    const Chart chart = {fmt::format("directions-chart-{}", extent.width),
                         directions_finding(records, extent),
                         fmt::format("Time per direction of each sampler under each density, on {}",
                                     extent_text(extent)),
                         is_last ? std::string(kNote) : "", directions_chart(records, extent)};
    html +=
        chart_figure(chart, is_last ? collapsible("Directions as a table", table.html()) +
                                          download_link("directions.csv", directions_csv(records))
                                    : "");
  }
  return html;
}

}  // namespace lightproof
