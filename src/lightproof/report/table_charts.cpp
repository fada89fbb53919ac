// Speed, size and accuracy of the samplers' tables, in one chart.
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

/// Classes of the worst texel's relative error; larger marks are farther off.
constexpr const char* kExact = "below 1e-5";
constexpr const char* kClose = "below 0.1 %";
constexpr const char* kOff = "0.1 % or more";

const char* error_class(double error) {
  if (error < 1e-5) return kExact;
  return error < 1e-3 ? kClose : kOff;
}

Json row_of(const TableRecord& record, bool is_unbeaten) {
  return {{"series", record.sampler},
          {"ns", rounded(record.ns_per_sample)},
          {"bytes", rounded(record.bytes_per_texel)},
          {"error", rounded(record.worst_texel_error)},
          {"accuracy", error_class(record.worst_texel_error)},
          {"front", is_unbeaten ? "not beaten" : "beaten in all three"}};
}

Json axis_of(const char* field, const char* title, const LogRange& range) {
  Json axis = quantity(field, title, "log");
  axis["axis"] = log_axis(range.low, range.high);
  axis["scale"]["padding"] = 24;
  return axis;
}

/// Rings around what is not beaten.
Json rings() {
  return {
      {"transform", {{{"filter", "datum.front == 'not beaten'"}}}},
      {"mark", {{"type", "point"}, {"shape", "circle"}, {"size", 420}, {"color", kFrontColour}}},
      {"encoding", Json::object()}};
}

Json dots(const std::vector<SeriesStyle>& styles) {
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  Json size = {{"field", "accuracy"},
               {"type", "ordinal"},
               {"scale", {{"domain", {kExact, kClose, kOff}}, {"range", {50, 130, 260}}}}};
  size["legend"] = {{"title", "worst texel's error"}, {"columns", 3}};
  return {{"mark", {{"type", "point"}, {"filled", true}, {"opacity", 1}}},
          {"encoding",
           {{"color", series(styles, &SeriesStyle::colour, legend)},
            {"shape", series(styles, &SeriesStyle::shape, legend)},
            {"size", size},
            {"tooltip",
             {tooltip("series", "sampler", ""), tooltip("ns", "ns per sample", ".3~g"),
              tooltip("bytes", "bytes per texel", ".3~g"),
              tooltip("error", "worst texel's relative error", ".2~g"),
              tooltip("front", "time, size and error", "")}}}}};
}

}  // namespace

std::string table_chart(const std::vector<TableRecord>& records) {
  const std::vector<TableRecord> drawn = of_largest_map(records);
  const std::vector<TableRecord> unbeaten = unbeaten_tables(drawn);
  Json rows = Json::array();
  LogRange sizes;
  LogRange times;
  std::vector<std::string> names;
  for (const TableRecord& record : drawn) {
    if (!drawable(record.bytes_per_texel) || !drawable(record.ns_per_sample)) continue;
    const bool is_unbeaten =
        std::any_of(unbeaten.begin(), unbeaten.end(),
                    [&](const TableRecord& best) { return best.sampler == record.sampler; });
    names.push_back(record.sampler);
    rows.push_back(row_of(record, is_unbeaten));
    sizes.add(record.bytes_per_texel);
    times.add(record.ns_per_sample);
  }
  Json chart = base_chart(380);
  chart["data"] = {{"values", rows}};
  chart["encoding"] = {
      {"x", axis_of("bytes", "size of the table (bytes per texel, log)", sizes)},
      {"y", axis_of("ns", "time per sample, random numbers included (ns, log)", times)}};
  chart["layer"] = {rings(), dots(series_styles(names))};
  return text_of(chart);
}

}  // namespace lightproof
