// Point sets: how fast integrals over them converge, how even they are, what float leaves of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/measured_csv.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr int kRowHeight = 20;
constexpr const char* kRuleColour = "#9aa3ad";
/// The index near which what is left in float is told in a sentence: some minutes of a shader's
/// frame counter times samples a frame.
constexpr std::uint64_t kToldIndex = 1U << 20U;

const PointRate* steepest(const std::vector<PointRate>& rates, std::string_view roughness) {
  const PointRate* best = nullptr;
  for (const PointRate& rate : rates) {
    if (rate.roughness != roughness || !std::isfinite(rate.exponent)) continue;
    if (best == nullptr || rate.exponent < best->exponent) best = &rate;
  }
  return best;
}

std::string rate_text(const PointRate& rate) {
  return fmt::format("N^({})", with_error(rate.exponent, rate.exponent_error));
}

std::string rate_finding(const std::vector<PointRate>& rates) {
  const PointRate* smooth = steepest(rates, "smooth");
  if (smooth == nullptr) return "No error fell as a power of the number of points";
  std::string text = fmt::format("Errors of {} fall fastest where the integrand is smooth, as {}",
                                 smooth->set, rate_text(*smooth));
  double slowest = -HUGE_VAL;
  double fastest = HUGE_VAL;
  for (const PointRate& rate : rates) {
    const bool is_even = rate.kind != "random" && rate.kind != "hash";
    if (rate.roughness != "edge" || !is_even || !std::isfinite(rate.exponent)) continue;
    slowest = std::max(slowest, rate.exponent);
    fastest = std::min(fastest, rate.exponent);
  }
  if (slowest < fastest) return text;
  return text + fmt::format("; at edges those of all even sets as N^({}) to N^({})",
                            format_number(slowest, 2), format_number(fastest, 2));
}

std::vector<std::string> integrands_of(const std::vector<PointRate>& rates) {
  std::vector<std::string> names;
  for (const PointRate& rate : rates) {
    names.push_back(fmt::format("{} ({})", rate.integrand, rate.roughness));
  }
  return unique_names(names);
}

/// Names of sets as rows from top to bottom, in the order of the records.
Json set_axis(const Json& names) {
  return {{"field", "set"},
          {"type", "nominal"},
          {"title", nullptr},
          {"sort", names},
          {"axis", {{"grid", true}, {"labelLimit", 150}, {"labelOverlap", false}}}};
}

Json set_names(const std::vector<std::string>& sets) {
  Json names = Json::array();
  for (const std::string& name : unique_names(sets)) names.push_back(name);
  return names;
}

std::string rate_chart(const std::vector<PointRate>& rates) {
  Json rows = Json::array();
  std::vector<std::string> sets;
  for (const PointRate& rate : rates) {
    sets.push_back(rate.set);
    if (!std::isfinite(rate.exponent)) continue;
    rows.push_back({{"set", rate.set},
                    {"series", fmt::format("{} ({})", rate.integrand, rate.roughness)},
                    {"exponent", rounded(rate.exponent)},
                    {"se", rounded(rate.exponent_error)},
                    {"low", rounded(rate.exponent - kBarHalfLength * rate.exponent_error)},
                    {"high", rounded(rate.exponent + kBarHalfLength * rate.exponent_error)}});
  }
  const Json names = set_names(sets);
  const std::vector<SeriesStyle> styles = series_styles(integrands_of(rates));
  const Json legend = {{"title", nullptr}};
  const Json x =
      quantity("exponent", "exponent of the error against the number of points", "linear");
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json low = x;
  low["field"] = "low";
  Json chart = base_chart(kRowHeight * static_cast<int>(names.size()) + 20);
  const Json rules = {
      {"data",
       {{"values", {{{"x", -0.5}}, {{"x", -0.75}}, {{"x", -1.0}}, {{"x", -1.25}}, {{"x", -1.5}}}}}},
      {"mark", {{"type", "rule"}, {"color", kRuleColour}, {"strokeDash", {4, 3}}}},
      {"encoding", {{"x", {{"field", "x"}, {"type", "quantitative"}}}}}};
  const Json bars = {
      {"data", {{"values", rows}}},
      {"mark", {{"type", "rule"}, {"strokeWidth", 1.5}}},
      {"encoding",
       {{"y", set_axis(names)}, {"x", low}, {"x2", {{"field", "high"}}}, {"color", colour}}}};
  const Json dots = {
      {"data", {{"values", rows}}},
      {"mark", {{"type", "point"}, {"filled", true}, {"size", 50}, {"opacity", 0.9}}},
      {"encoding",
       {{"y", set_axis(names)},
        {"x", x},
        {"color", colour},
        {"shape", series(styles, &SeriesStyle::shape, legend)},
        {"tooltip",
         {tooltip("set", "point set", ""), tooltip("series", "integrand", ""),
          tooltip("exponent", "exponent", ".3f"), tooltip("se", "standard error", ".2~g")}}}}};
  chart["layer"] = {rules, bars, dots};
  return text_of(chart);
}

std::string rate_table(const std::vector<PointRate>& rates) {
  std::vector<std::string> columns = {"Point set", "Kind"};
  const std::vector<std::string> integrands = integrands_of(rates);
  for (const std::string& integrand : integrands) {
    columns.push_back("Exponent: " + integrand);
    columns.push_back("Error at the most points");
  }
  Table table("Rates of convergence", columns);
  for (auto rate = rates.begin(); rate != rates.end();) {
    std::vector<Cell> row = {text_cell(rate->set), text_cell(rate->kind)};
    for (const std::string set = rate->set; rate != rates.end() && rate->set == set; ++rate) {
      row.push_back({with_error(rate->exponent, rate->exponent_error), "number",
                     fmt::format("{} on {}", set, rate->integrand)});
      row.push_back(number_cell(rate->errors.empty() ? std::nan("") : rate->errors.back().rmse, 2));
    }
    table.add(row);
  }
  return table.html();
}

std::string rate_note(const std::vector<PointRate>& rates) {
  const PointRate& one = rates.front();
  const std::uint64_t first = one.errors.empty() ? 0 : one.errors.front().points;
  const std::uint64_t last = one.errors.empty() ? 0 : one.errors.back().points;
  return fmt::format(
      "Root mean square error over {} seeds, at {} numbers of points from {} to {}: random sets "
      "are "
      "drawn anew, all others shifted or scrambled. Exponents by weighted least squares on "
      "logarithms; bars are two standard errors on either side, from the errors' own or, where a "
      "set follows no power law, from their scatter about it. Dashed: \u22121/2 is the rate of "
      "independent points, \u22123/4 that of nets and strata at an edge, \u22121 that of strata, "
      "\u22125/4 and \u22123/2 those of scrambled nets on a kink and on a smooth integrand.",
      one.seeds, count_word(one.errors.size()), with_thousands(first), with_thousands(last));
}

std::uint64_t most_points(const std::vector<PointDiscrepancy>& all) {
  std::uint64_t most = 0;
  for (const PointDiscrepancy& r : all) most = std::max(most, r.points);
  return most;
}

std::string discrepancy_finding(const std::vector<PointDiscrepancy>& all) {
  const PointDiscrepancy* best = nullptr;
  for (const PointDiscrepancy& r : all) {
    if (r.points != most_points(all)) continue;
    if (best == nullptr || r.l2_star < best->l2_star) best = &r;
  }
  if (best == nullptr) return "The evenness of point sets was not measured";
  return fmt::format(
      "The most even of {} points are those of {}: their L2 star discrepancy is {} of that of "
      "independent points",
      with_thousands(best->points), best->set, percent(best->l2_star / best->independent_l2));
}

std::string discrepancy_chart(const std::vector<PointDiscrepancy>& all) {
  Json rows = Json::array();
  LogRange range;
  std::vector<std::string> sets;
  const std::uint64_t most = most_points(all);
  for (const PointDiscrepancy& r : all) {
    if (r.points != most) continue;
    sets.push_back(r.set);
    const std::pair<const char*, double> measures[] = {{"star discrepancy", r.star},
                                                       {"L2 star discrepancy", r.l2_star}};
    for (const auto& [name, value] : measures) {
      if (!drawable(value)) continue;
      range.add(value);
      rows.push_back({{"set", r.set}, {"series", name}, {"value", rounded(value)}});
    }
  }
  const Json names = set_names(sets);
  const std::vector<SeriesStyle> styles =
      series_styles({"star discrepancy", "L2 star discrepancy"});
  const Json legend = {{"title", nullptr}};
  Json x =
      quantity("value", fmt::format("discrepancy of {} points (log)", with_thousands(most)), "log");
  x["axis"] = log_axis(range.low, range.high);
  Json chart = base_chart(kRowHeight * static_cast<int>(names.size()) + 20);
  chart["data"] = {{"values", rows}};
  const Json mark = {{"type", "point"}, {"filled", true}, {"size", 60}, {"opacity", 1}};
  chart["layer"] = Json::array({{{"mark", mark}, {"encoding", Json::object()}}});
  chart["encoding"] = {{"y", set_axis(names)},
                       {"x", x},
                       {"color", series(styles, &SeriesStyle::colour, legend)},
                       {"shape", series(styles, &SeriesStyle::shape, legend)},
                       {"tooltip",
                        {tooltip("set", "point set", ""), tooltip("series", "measure", ""),
                         tooltip("value", "discrepancy", ".3~g")}}};
  return text_of(chart);
}

std::string discrepancy_table(const std::vector<PointDiscrepancy>& all) {
  Table table("Discrepancies", {"Point set", "Kind", "Points", "Star discrepancy",
                                "L2 star discrepancy", "L2 of independent points"});
  for (const PointDiscrepancy& r : all) {
    table.add({text_cell(r.set),
               text_cell(r.kind),
               {with_thousands(r.points), "number", ""},
               number_cell(r.star),
               number_cell(r.l2_star),
               number_cell(r.independent_l2)});
  }
  return table.html();
}

/// Different values of the coordinate that has fewer.
std::uint64_t fewest(const PointDecay& r) { return std::min(r.distinct_s, r.distinct_t); }

std::string decay_finding(const std::vector<PointDecay>& decay) {
  const PointDecay* worst = nullptr;
  for (const PointDecay& r : decay) {
    if (r.first != kToldIndex) continue;
    if (worst == nullptr || r.distinct < worst->distinct) worst = &r;
  }
  if (worst == nullptr) return "What float leaves of point sets as the index grows";
  const auto coarse = static_cast<std::size_t>(std::ranges::count_if(
      decay, [](const PointDecay& r) { return r.first == kToldIndex && fewest(r) <= 256; }));
  return fmt::format(
      "From index {} on, {} of the {} sets in float {} at most 256 different values of a "
      "coordinate "
      "in {} points; {} has {} different points",
      with_thousands(kToldIndex), count_word(coarse),
      count_word(
          static_cast<std::size_t>(std::ranges::count(decay, kToldIndex, &PointDecay::first))),
      coarse == 1 ? "has" : "have", with_thousands(worst->window), worst->set,
      with_thousands(worst->distinct));
}

std::string decay_chart(const std::vector<PointDecay>& decay) {
  Json rows = Json::array();
  LogRange range;
  std::vector<std::string> names;
  for (const PointDecay& r : decay) {
    if (r.first == 0) continue;
    names.push_back(r.set);
    range.add(static_cast<double>(fewest(r)));
    rows.push_back({{"series", r.set},
                    {"first", r.first},
                    {"distinct", fewest(r)},
                    {"points", r.distinct},
                    {"s", r.distinct_s},
                    {"t", r.distinct_t}});
  }
  const std::vector<SeriesStyle> styles = series_styles(names);
  const Json legend = {{"title", nullptr}};
  Json x = quantity("first", "index of the window's first point (log)", "log");
  x["axis"] = log_axis(1.0, 4e9);
  x["axis"]["tickCount"] = 10;
  x["scale"]["nice"] = false;
  x["scale"]["padding"] = 12;
  Json y = quantity("distinct", "different values of a coordinate (log)", "log");
  y["axis"] = log_axis(1.0, 65536.0);
  y["scale"]["domain"] = {0.8, 1e5};
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  Json chart = base_chart(340);
  chart["data"] = {{"values", rows}};
  chart["encoding"] = {{"x", x}, {"y", y}};
  Json dots = {{"mark", {{"type", "point"}, {"filled", true}, {"size", 45}, {"opacity", 0.9}}},
               {"encoding",
                {{"color", colour},
                 {"shape", series(styles, &SeriesStyle::shape, legend)},
                 {"tooltip",
                  {tooltip("series", "point set", ""), tooltip("first", "from index", ",d"),
                   tooltip("points", "different points", ",d"), tooltip("s", "different s", ",d"),
                   tooltip("t", "different t", ",d")}}}}};
  chart["layer"] = {
      {{"mark", {{"type", "line"}, {"strokeWidth", 2}}}, {"encoding", {{"color", colour}}}}, dots};
  return text_of(chart);
}

std::string decay_table(const std::vector<PointDecay>& decay) {
  Table table("Points in float",
              {"Point set", "From index", "Points", "Different points", "Different s",
               "Different t", "Largest error of s", "Largest error of t"});
  const auto count = [](std::uint64_t value) { return Cell{with_thousands(value), "number", ""}; };
  for (const PointDecay& r : decay) {
    table.add({text_cell(r.set), count(r.first), count(r.window), count(r.distinct),
               count(r.distinct_s), count(r.distinct_t), number_cell(r.error_s, 2),
               number_cell(r.error_t, 2)});
  }
  return table.html();
}

constexpr std::string_view kDiscrepancyNote =
    "The star discrepancy is the largest difference between the share of the points in a box with "
    "a "
    "corner at the origin and its area, the L2 star discrepancy the root mean square of the "
    "differences over all boxes; both exact. Of one set of each kind: sets that are shifted or "
    "scrambled for estimates are taken as they are here.";

constexpr std::string_view kDecayNote =
    "Of the coordinate that has fewer values, over as many successive points from each index on. "
    "The larger an index is as a float, the fewer bits it leaves behind the point, and from "
    "2\u00b2\u2074 on "
    "not even neighbouring indices differ. In fixed point, as Lightproof computes these sets, "
    "lattices and nets keep all values; of independent ones, some coincide by chance.";

}  // namespace

std::string point_section(const PointStudy& points) {
  std::string html = "<section id=\"points\">\n<h2>Point sets</h2>\n";
  if (points.rates.empty() && points.discrepancies.empty() && points.decay.empty()) {
    return html + paragraph("Point sets were not measured in this study.", "empty") +
           "</section>\n";
  }
  if (!points.rates.empty()) {
    html += chart_figure({"points-rates", rate_finding(points.rates),
                          "Exponents of the error against the number of points, of every point set "
                          "on every integrand",
                          rate_note(points.rates), rate_chart(points.rates)},
                         collapsible("Rates as a table", rate_table(points.rates)) +
                             download_link("points.csv", point_errors_csv(points.rates)));
  }
  if (!points.discrepancies.empty()) {
    html += chart_figure(
        {"points-discrepancy", discrepancy_finding(points.discrepancies),
         "Discrepancies of every point set", std::string(kDiscrepancyNote),
         discrepancy_chart(points.discrepancies)},
        collapsible("Discrepancies as a table", discrepancy_table(points.discrepancies)) +
            download_link("discrepancy.csv", discrepancy_csv(points.discrepancies)));
  }
  if (!points.decay.empty()) {
    html += chart_figure({"points-decay", decay_finding(points.decay),
                          "Different values of a coordinate against the index, of the point sets "
                          "that are computed in float",
                          std::string(kDecayNote), decay_chart(points.decay)},
                         collapsible("Points in float as a table", decay_table(points.decay)) +
                             download_link("decay.csv", decay_csv(points.decay)));
  }
  return html + "</section>\n";
}

}  // namespace lightproof
