// Speed against accuracy and against size of the samplers' tables, with the Pareto front.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/pareto.h"

namespace lightproof {
namespace {

constexpr const char* kFrontColour = "#1d232a";

Json row_of(const TableRecord& record, TableCost cost, bool on_front) {
  return {{"series", record.sampler},
          {"cost", rounded(record.*cost)},
          {"ns", rounded(record.ns_per_sample)},
          {"bytes", rounded(record.bytes_per_texel)},
          {"error", rounded(record.worst_texel_error)},
          {"front", on_front ? "on the front" : "beaten in both"}};
}

Json axis_of(const char* field, const char* title, const LogRange& range) {
  Json axis = quantity(field, title, "log");
  axis["axis"] = log_axis(range.low, range.high);
  axis["scale"]["padding"] = 24;
  return axis;
}

Json front_line() {
  return {{"transform", {{{"filter", "datum.front == 'on the front'"}}}},
          {"mark",
           {{"type", "line"},
            {"color", kFrontColour},
            {"strokeWidth", 1.5},
            {"strokeDash", {4, 3}},
            {"interpolate", "step-after"}}},
          {"encoding", {{"order", {{"field", "cost"}, {"type", "quantitative"}}}}}};
}

/// Rings around what is on the front.
Json rings() {
  return {
      {"transform", {{{"filter", "datum.front == 'on the front'"}}}},
      {"mark", {{"type", "point"}, {"shape", "circle"}, {"size", 220}, {"color", kFrontColour}}},
      {"encoding", Json::object()}};
}

Json dots(const std::vector<SeriesStyle>& styles) {
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  return {{"mark", {{"type", "point"}, {"filled", true}, {"size", 70}, {"opacity", 1}}},
          {"encoding",
           {{"color", series(styles, &SeriesStyle::colour, legend)},
            {"shape", series(styles, &SeriesStyle::shape, legend)},
            {"tooltip",
             {tooltip("series", "sampler", ""), tooltip("ns", "ns per sample", ".3~g"),
              tooltip("bytes", "bytes per texel", ".3~g"),
              tooltip("error", "worst texel's relative error", ".2~g"),
              tooltip("front", "Pareto front", "")}}}}};
}

}  // namespace

std::string table_chart(const std::vector<TableRecord>& records, TableCost cost,
                        const std::string& cost_name) {
  const std::vector<TableRecord> drawn = of_largest_map(records);
  const std::vector<TableRecord> front = pareto_front(drawn, cost, &TableRecord::ns_per_sample);
  Json rows = Json::array();
  LogRange costs;
  LogRange times;
  std::vector<std::string> names;
  for (const TableRecord& record : drawn) {
    if (!drawable(record.*cost) || !drawable(record.ns_per_sample)) continue;
    const bool on_front = std::any_of(front.begin(), front.end(), [&](const TableRecord& best) {
      return best.sampler == record.sampler;
    });
    names.push_back(record.sampler);
    rows.push_back(row_of(record, cost, on_front));
    costs.add(record.*cost);
    times.add(record.ns_per_sample);
  }
  Json chart = base_chart(380);
  chart["data"] = {{"values", rows}};
  chart["encoding"] = {
      {"x", axis_of("cost", cost_name.c_str(), costs)},
      {"y", axis_of("ns", "time per sample, random numbers included (ns, log)", times)}};
  chart["layer"] = {front_line(), rings(), dots(series_styles(names))};
  return text_of(chart);
}

}  // namespace lightproof
