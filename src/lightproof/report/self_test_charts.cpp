#include "lightproof/report/self_test_charts.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

constexpr int kRowHeight = 17;
constexpr int kLeastHeight = 120;

Json kill_rows(const std::vector<KillRecord>& mutants) {
  Json rows = Json::array();
  for (const KillRecord& mutant : mutants) {
    for (const KillRecord::Kill& kill : mutant.kills) {
      const bool named = describe(kill.test).oracle == mutant.oracle;
      rows.push_back({{"mutant", mutant.mutant},
                      {"test", full_name(kill.test)},
                      {"samples", kill.samples},
                      {"needs", with_thousands(kill.samples)},
                      {"named", named ? "yes" : "no"}});
    }
  }
  return rows;
}

Json names_of(const std::vector<KillRecord>& mutants) {
  Json names = Json::array();
  for (const KillRecord& mutant : mutants) names.push_back(mutant.mutant);
  return names;
}

Json deviation_rows(const std::vector<CalibrationRecord>& tests) {
  Json rows = Json::array();
  for (const CalibrationRecord& test : tests) {
    for (std::size_t i = 0; i < test.quantiles.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(test.quantiles.size() - 1);
      rows.push_back({{"test", full_name(test.test)},
                      {"series", test.is_bound ? "bound: may be too large" : "exact"},
                      {"p", rounded(test.quantiles[i])},
                      {"deviation", rounded(share - test.quantiles[i])}});
    }
  }
  return rows;
}

Json limits(double limit) {
  return {{"mark",
           {{"type", "rule"}, {"color", "#1d232a"}, {"strokeDash", {5, 4}}, {"strokeWidth", 1}}},
          {"data", {{"values", {{{"limit", limit}}, {{"limit", -limit}}}}}},
          {"encoding", {{"y", {{"field", "limit"}, {"type", "quantitative"}}}}}};
}

Json power_rows(const std::vector<PowerRecord>& power) {
  Json rows = Json::array();
  for (const PowerRecord& r : power) {
    const double measured = static_cast<double>(r.rejected) / static_cast<double>(r.replicates);
    const double error = std::sqrt(measured * (1.0 - measured) / static_cast<double>(r.replicates));
    rows.push_back({{"series", full_name(r.test) + (r.is_bound ? " (at least)" : "")},
                    {"samples", r.samples},
                    {"measured", rounded(measured)},
                    {"low", rounded(measured - kBarHalfLength * error)},
                    {"high", rounded(measured + kBarHalfLength * error)},
                    {"predicted", rounded(r.predicted)}});
  }
  return rows;
}

}  // namespace

double calibration_limit(std::uint64_t replicates) {
  return std::sqrt(std::log(2.0 / 1e-6) / (2.0 * static_cast<double>(replicates)));
}

std::string kill_chart(const std::vector<KillRecord>& mutants) {
  Json chart = base_chart(std::max(kLeastHeight, kRowHeight * static_cast<int>(mutants.size())));
  chart["data"] = {{"values", kill_rows(mutants)}};
  const Json y = {{"field", "mutant"},
                  {"type", "nominal"},
                  {"title", nullptr},
                  {"scale", {{"domain", names_of(mutants)}}},
                  {"axis", {{"labelFontSize", 11}, {"labelOverlap", false}, {"labelLimit", 220}}}};
  const Json x = {{"field", "test"},
                  {"type", "nominal"},
                  {"title", nullptr},
                  {"axis",
                   {{"labelAngle", -55},
                    {"labelFontSize", 11},
                    {"labelOverlap", false},
                    {"labelLimit", 260},
                    {"grid", true}}}};
  const Json colour = {{"field", "samples"},
                       {"type", "ordinal"},
                       {"title", "samples"},
                       {"scale", {{"scheme", "viridis"}, {"reverse", true}}},
                       {"legend", {{"format", ",d"}, {"columns", 6}}}};
  const Json border = {{"condition", {{"test", "datum.named == 'yes'"}, {"value", "#1d232a"}}},
                       {"value", nullptr}};
  Json cells = {{"mark", {{"type", "rect"}, {"strokeWidth", 1.2}}}};
  cells["encoding"] = {{"x", x}, {"y", y}, {"color", colour}, {"stroke", border}};
  cells["encoding"]["tooltip"] = {tooltip("mutant", "mutant", ""), tooltip("test", "test", ""),
                                  tooltip("needs", "samples", ""),
                                  tooltip("named", "its own oracle", "")};
  chart["layer"] = Json::array({cells});
  return text_of(chart);
}

std::string calibration_chart(const std::vector<CalibrationRecord>& tests) {
  const std::vector<SeriesStyle> styles = series_styles({"exact", "bound: may be too large"});
  const double limit = calibration_limit(tests.front().replicates);
  Json y = quantity("deviation", "share of p-values below, less p", "linear");
  // Bounds run far below the limits: all of it is inside the frame.
  y["scale"] = {{"type", "symlog"}, {"constant", limit}, {"zero", false}};
  y["axis"] = {{"format", ".2~g"}};
  Json lines = {
      {"mark", {{"type", "line"}, {"strokeWidth", 1.3}, {"opacity", 0.75}, {"clip", true}}}};
  lines["encoding"] = {{"x", quantity("p", "p-value", "linear")},
                       {"y", y},
                       {"color", series(styles, &SeriesStyle::colour, {{"title", nullptr}})},
                       {"detail", {{"field", "test"}}},
                       {"tooltip",
                        {tooltip("test", "test", ""), tooltip("p", "p", ".3f"),
                         tooltip("deviation", "deviation", ".4f")}}};
  Json chart = base_chart(340);
  chart["data"] = {{"values", deviation_rows(tests)}};
  chart["layer"] = {lines, limits(limit)};
  return text_of(chart);
}

std::string power_chart(const std::vector<PowerRecord>& power) {
  std::vector<std::string> names;
  LogRange range;
  for (const PowerRecord& r : power) {
    names.push_back(full_name(r.test) + (r.is_bound ? " (at least)" : ""));
    range.add(static_cast<double>(r.samples));
  }
  const std::vector<SeriesStyle> styles = series_styles(names);
  const Json legend = {{"title", nullptr}, {"columns", 3}};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  const auto share = [](const char* field) {
    Json y = quantity(field, "share of samples that are rejected", "linear");
    y["scale"]["domain"] = {0, 1};
    return y;
  };
  const Json lines = {{"mark", {{"type", "line"}, {"strokeWidth", 2}}},
                      {"encoding", {{"y", share("predicted")}, {"color", colour}}}};
  const Json bars = {
      {"mark", {{"type", "rule"}, {"strokeWidth", 1.5}, {"opacity", 0.6}, {"clip", true}}},
      {"encoding", {{"y", share("low")}, {"y2", {{"field", "high"}}}, {"color", colour}}}};
  Json points = {{"mark", {{"type", "point"}, {"filled", true}, {"size", 60}}}};
  points["encoding"] = {
      {"y", share("measured")},
      {"color", colour},
      {"shape", series(styles, &SeriesStyle::shape, legend)},
      {"tooltip",
       {tooltip("series", "test", ""), tooltip("samples", "samples", ",d"),
        tooltip("measured", "measured", ".3f"), tooltip("predicted", "predicted", ".3f")}}};
  Json x = quantity("samples", "samples (log)", "log");
  x["axis"] = log_axis(range.low, range.high);
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 16;
  Json chart = base_chart(360);
  chart["data"] = {{"values", power_rows(power)}};
  chart["encoding"] = {{"x", x}};
  chart["layer"] = {lines, bars, points};
  return text_of(chart);
}

}  // namespace lightproof
