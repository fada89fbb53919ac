// The costs of every sampler against the size of the map: time per sample, time to build.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

constexpr const char* kFrameColour = "#1d232a";

/// A frame around a point, as an outline in [-1,1]^2 that the legend shows as well.
struct Frame {
  const char* outline;  ///< an SVG path
  double area;          ///< px^2 of its square
};
/// One inside the other, where a point has several.
constexpr std::array<Frame, 3> kFrames = {
    {{"M1,0A1,1,0,1,1,-1,0A1,1,0,1,1,1,0ZM.78,0A.78,.78,0,1,0,-.78,0A.78,.78,0,1,0,.78,0Z", 150},
     {"M-1,-1H1V1H-1ZM-.83,-.83V.83H.83V-.83Z", 260},
     {"M0,-1L1,0L0,1L-1,0ZM0,-.82L-.82,0L0,.82L.82,0Z", 680}}};

const GrowthFit* fit_of(const std::string& sampler, const std::vector<GrowthFit>& growth) {
  const auto fit = std::find_if(growth.begin(), growth.end(),
                                [&](const GrowthFit& g) { return g.sampler == sampler; });
  return fit == growth.end() ? nullptr : &*fit;
}

std::optional<double> exponent_of_samples(const GrowthFit& fit) { return fit.exponent; }

double sides(Extent extent) { return extent.width + extent.height; }

/// What the chart shows.
struct Costs {
  double ThroughputRecord::*value;
  double ThroughputRecord::*low;  ///< where bars begin and end
  double ThroughputRecord::*high;
  const char* name;  ///< title of the axis
  double (*size)(Extent);
  const char* size_name;
  std::optional<double> (*exponent)(const GrowthFit&);
};

constexpr Costs kTimePerSample = {&ThroughputRecord::ns_per_sample,
                                  &ThroughputRecord::ns_low,
                                  &ThroughputRecord::ns_high,
                                  "time per sample (ns, log)",
                                  sides,
                                  "map size, by width S + height T (log)",
                                  exponent_of_samples};
/// "linear_scan, exponent 0.97", or the name alone without a fit.
std::string label_of(const std::string& sampler, const StudyResult& study, const Costs& costs) {
  const GrowthFit* fit = fit_of(sampler, study.growth);
  const auto exponent = fit == nullptr ? std::nullopt : costs.exponent(*fit);
  if (!exponent) return sampler;
  return fmt::format("{}, exponent {}", sampler, format_number(*exponent, 2));
}

/// Labels stand at powers of two, where there are any: with those between they would overlap.
Json size_axis(const std::vector<ThroughputRecord>& records, const Costs& costs) {
  std::map<double, std::string> all;
  std::map<double, std::string> powers;
  for (const ThroughputRecord& r : records) {
    const std::pair size(costs.size(r.extent), extent_text(r.extent));
    all.insert(size);
    if (std::has_single_bit(static_cast<unsigned>(r.extent.width))) powers.insert(size);
  }
  Json values = Json::array();
  std::string label = "''";
  for (const auto& [size, text] : powers.empty() ? all : powers) {
    values.push_back(size);
    label = fmt::format("datum.value == {} ? '{}' : {}", size, text, label);
  }
  Json x = quantity("size", costs.size_name, "log");
  x["axis"] = {{"values", values}, {"labelExpr", label}};
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 36;
  return x;
}

Json cost_axis(const std::string& field, const Costs& costs, LogRange range) {
  Json y = quantity(field, costs.name, "log");
  y["axis"] = log_axis(range.low, range.high);
  y["scale"]["nice"] = false;
  y["scale"]["padding"] = 16;
  return y;
}

Json row_of(const ThroughputRecord& r, const Costs& costs, const std::string& series) {
  const double value = r.*costs.value;
  return {{"series", series},
          {"sampler", r.sampler},
          {"map", r.map},
          {"extent", extent_text(r.extent)},
          {"size", costs.size(r.extent)},
          {"cost", rounded(value)},
          {"low", rounded(drawable(r.*costs.low) ? r.*costs.low : value)},
          {"high", rounded(drawable(r.*costs.high) ? r.*costs.high : value)},
          {"table", bytes_text(r.table_bytes)}};
}

constexpr std::string_view kUsualSampler = "binary_search";

/// The fastest and the slowest sampler on the largest map, and the usual one.
std::vector<std::string> leading_samplers(const std::vector<ThroughputRecord>& records) {
  const auto rank = [](const ThroughputRecord& r) {
    return std::pair(r.extent.count(), r.ns_per_sample);
  };
  const auto slowest =
      std::max_element(records.begin(), records.end(),
                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  const auto fastest =
      std::min_element(records.begin(), records.end(), [&](const auto& a, const auto& b) {
        const auto first_largest = [&](const ThroughputRecord& r) {
          return std::pair(slowest->extent.count() - r.extent.count(), r.ns_per_sample);
        };
        return first_largest(a) < first_largest(b);
      });
  return {fastest->sampler, slowest->sampler, std::string(kUsualSampler)};
}

void mark_leading(Json& rows, const StudyResult& study) {
  const std::vector<std::string> leading = leading_samplers(study.throughput);
  for (Json& row : rows) {
    row["leads"] = std::find(leading.begin(), leading.end(), row["sampler"].get<std::string>()) !=
                   leading.end();
  }
}

Json rows_of(const StudyResult& study, const Costs& costs) {
  Json rows = Json::array();
  for (const ThroughputRecord& r : study.throughput) {
    if (!drawable(r.*costs.value)) continue;
    rows.push_back(row_of(r, costs, label_of(r.sampler, study, costs)));
  }
  return rows;
}

/// Which points get which frame.
struct FramedPoints {
  SeriesStyle style;
  double area;
  Json rows = Json::array();
};

bool is_breakpoint(Extent extent, const std::optional<SegmentedGrowth>& breakpoints) {
  return breakpoints &&
         std::any_of(
             breakpoints->breakpoints.begin(), breakpoints->breakpoints.end(),
             [&](const GrowthBreakpoint& breakpoint) { return breakpoint.extent == extent; });
}

std::vector<FramedPoints> framed_points(const StudyResult& study) {
  const auto beyond = [](const char* cache, const std::optional<double>& bytes) {
    return fmt::format("first table beyond {} ({})", cache, bytes_text(bytes.value_or(0.0)));
  };
  const std::array<std::string, 3> names = {beyond("L2", study.caches.l2),
                                            beyond("L3", study.caches.l3),
                                            "measured breakpoint of the time of a step"};
  std::vector<FramedPoints> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all.push_back({{names[i], kFrameColour, kFrames[i].outline}, kFrames[i].area});
  }
  for (const ThroughputRecord& r : study.throughput) {
    const GrowthFit* fit = fit_of(r.sampler, study.growth);
    if (fit == nullptr || !drawable(r.ns_per_sample)) continue;
    const std::array<bool, 3> is_framed = {fit->leaves_l2 == r.extent, fit->leaves_l3 == r.extent,
                                           is_breakpoint(r.extent, fit->segmented)};
    for (std::size_t i = 0; i < is_framed.size(); ++i) {
      if (!is_framed[i]) continue;
      Json row = row_of(r, kTimePerSample, names[i]);
      row["area"] = all[i].area;
      all[i].rows.push_back(row);
    }
  }
  std::erase_if(all, [](const FramedPoints& points) { return points.rows.empty(); });
  return all;
}

Json tooltip_of(const Costs& costs) {
  return {tooltip("sampler", "sampler", ""),   tooltip("map", "map", ""),
          tooltip("extent", "map size", ""),   tooltip("table", "size of its table", ""),
          tooltip("cost", costs.name, ".3~g"), tooltip("low", "fastest", ".3~g"),
          tooltip("high", "slowest", ".3~g")};
}

Json lines(const Json& y, const Json& colour) {
  return {{"mark", {{"type", "line"}, {"strokeWidth", 2}}},
          {"encoding", {{"y", y}, {"color", colour}, {"detail", {{"field", "map"}}}}}};
}

/// The layers draw these encodings.
struct Encodings {
  Json y;
  Json colour;
  Json shape;
  Json tooltip;
};

Encodings encodings_of(const StudyResult& study, const Costs& costs,
                       const std::vector<FramedPoints>& framed) {
  std::vector<std::string> names;
  LogRange range;
  for (const ThroughputRecord& r : study.throughput) {
    names.push_back(label_of(r.sampler, study, costs));
    range.add(r.*costs.value);
  }
  std::vector<SeriesStyle> styles = series_styles(names);
  for (const FramedPoints& points : framed) styles.push_back(points.style);
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  return {cost_axis("cost", costs, range), series(styles, &SeriesStyle::colour, legend),
          series(styles, &SeriesStyle::shape, legend), tooltip_of(costs)};
}

Json dots(const Encodings& encodings) {
  Json layer = points(encodings.y, encodings.colour, encodings.shape);
  layer["encoding"]["tooltip"] = encodings.tooltip;
  return layer;
}

Json frames(const Encodings& encodings, const std::vector<FramedPoints>& framed) {
  Json layer = dots(encodings);
  Json rows = Json::array();
  for (const FramedPoints& points : framed) {
    rows.insert(rows.end(), points.rows.begin(), points.rows.end());
  }
  layer["data"] = {{"values", rows}};
  layer["mark"] = {{"type", "point"}, {"filled", true}, {"opacity", 1}};
  layer["encoding"]["size"] = {
      {"field", "area"}, {"type", "quantitative"}, {"scale", nullptr}, {"legend", nullptr}};
  return layer;
}

/// What was clicked in the legend, or what leads if nothing was.
Json strong_if_shown() {
  const Json test = {
      {"or",
       {{{"param", "shown"}, {"empty", false}}, {{"and", {{{"param", "shown"}}, "datum.leads"}}}}}};
  return {{"condition", {{"test", test}, {"value", 0.95}}}, {"value", 0.14}};
}

std::string cost_chart(const StudyResult& study, const Costs& costs,
                       const std::vector<FramedPoints>& framed) {
  const Encodings encodings = encodings_of(study, costs, framed);
  Json rows = rows_of(study, costs);
  mark_leading(rows, study);
  Json low = encodings.y;
  low["field"] = "low";
  Json chart = base_chart(420);
  chart["data"] = {{"values", rows}};
  chart["encoding"] = {{"x", size_axis(study.throughput, costs)}};
  chart["layer"] = {lines(encodings.y, encodings.colour), error_bars(low, encodings.colour),
                    dots(encodings)};
  if (!framed.empty()) {
    chart["layer"].push_back(frames(encodings, framed));
    mark_leading(chart["layer"].back()["data"]["values"], study);
    chart["layer"].back()["encoding"]["opacity"] = {
        {"condition", {{"test", "datum.leads"}, {"value", 1.0}}}, {"value", 0.12}};
  }
  for (std::size_t layer : {0U, 1U, 2U}) {
    chart["layer"][layer]["mark"].erase("opacity");
    chart["layer"][layer]["encoding"]["opacity"] = strong_if_shown();
  }
  chart["layer"][2]["params"] = {
      {{"name", "shown"},
       {"select", {{"type", "point"}, {"fields", {"series"}}, {"toggle", "true"}}},
       {"bind", "legend"}}};
  return text_of(chart);
}

}  // namespace

std::string throughput_chart(const StudyResult& study) {
  return cost_chart(study, kTimePerSample, framed_points(study));
}

}  // namespace lightproof
