// Hard inputs: the matrix of methods and cases as a picture, and where methods first fail.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/stability_tables.h"

namespace lightproof {
namespace {

constexpr int kRowHeight = 17;
constexpr int kHead = 60;

/// What a cell of the matrix shows, and its colour: the worse, the darker.
struct State {
  std::string_view name;
  std::string_view colour;
};
constexpr std::array<State, 8> kStates = {{{"right", "#8fc9a3"},
                                           {"refused, as required", "#bfe0ea"},
                                           {"not applicable", "#eceff1"},
                                           {"off by less than 1 %", "#f6d28b"},
                                           {"off by more", "#e8963e"},
                                           {"refused", "#9c7bb5"},
                                           {"out of range", "#c0504d"},
                                           {"not a number", "#5e1a1a"}}};
/// Below it a wrong result counts as slightly wrong.
constexpr double kSlightly = 0.01;

std::string_view state_of(const StabilityRecord& record) {
  switch (record.outcome) {
    case StabilityOutcome::right:
      return "right";
    case StabilityOutcome::wrong:
      return record.amount < kSlightly ? "off by less than 1 %" : "off by more";
    case StabilityOutcome::not_a_number:
      return "not a number";
    case StabilityOutcome::out_of_range:
      return "out of range";
    case StabilityOutcome::refused:
      return record.may_refuse ? "refused, as required" : "refused";
    case StabilityOutcome::not_applicable:
      return "not applicable";
  }
  return "";
}

std::string case_name(const StabilityResult& stability, int number) {
  for (const StabilityCaseRecord& row : stability.cases) {
    if (row.number == number) return fmt::format("{} {}", number, row.name);
  }
  return std::to_string(number);
}

std::string required_of(const StabilityResult& stability, int number) {
  for (const StabilityCaseRecord& row : stability.cases) {
    if (row.number == number) return row.required;
  }
  return "";
}

std::string claim_of(const StabilityRecord& record) {
  if (record.known_defects) return "kept as published";
  if (!record.limit.empty()) return "cannot: " + record.limit;
  return "claims to pass";
}

std::vector<std::string> kinds_of(const std::vector<StabilityRecord>& records) {
  std::vector<std::string> kinds;
  for (const StabilityRecord& record : records) kinds.push_back(record.kind);
  return unique_names(kinds);
}

std::string plural(std::string kind) {
  if (!kind.ends_with('y')) return kind + "s";
  kind.pop_back();
  return kind + "ies";
}

Json state_scale(const std::vector<std::string>& shown) {
  Json domain = Json::array();
  Json range = Json::array();
  for (const State& state : kStates) {
    if (std::find(shown.begin(), shown.end(), state.name) == shown.end()) continue;
    domain.push_back(state.name);
    range.push_back(state.colour);
  }
  return {{"domain", domain}, {"range", range}};
}

Json names_json(const std::vector<std::string>& names) {
  Json list = Json::array();
  for (const std::string& name : unique_names(names)) list.push_back(name);
  return list;
}

Json method_axis(const std::vector<std::string>& methods) {
  return {{"field", "method"},
          {"type", "nominal"},
          {"title", nullptr},
          {"scale", {{"domain", names_json(methods)}}},
          {"axis", {{"labelFontSize", 11}, {"labelOverlap", false}, {"labelLimit", 170}}}};
}

Json case_axis(const std::vector<std::string>& numbers) {
  return {{"field", "number"},
          {"type", "nominal"},
          {"title", "number of the case"},
          {"scale", {{"domain", names_json(numbers)}}},
          {"axis", {{"labelFontSize", 11}, {"labelOverlap", false}, {"labelAngle", 0}}}};
}

/// The matrix of one kind of method.
std::string matrix_chart(const StabilityResult& stability, const std::string& kind) {
  Json rows = Json::array();
  std::vector<std::string> methods;
  std::vector<std::string> numbers;
  std::vector<std::string> states;
  for (const StabilityRecord& record : stability.records) {
    if (record.kind != kind) continue;
    methods.push_back(record.method);
    numbers.push_back(std::to_string(record.number));
    states.emplace_back(state_of(record));
    rows.push_back({{"method", record.method},
                    {"number", numbers.back()},
                    {"case", case_name(stability, record.number)},
                    {"state", states.back()},
                    {"required", required_of(stability, record.number)},
                    {"input", record.put_in},
                    {"output", record.came_out},
                    {"amount", significant(record.amount)},
                    {"bound", significant(record.bound)},
                    {"claim", claim_of(record)},
                    {"broken", breaks_claim(record) ? "yes" : "no"}});
  }
  const auto count = static_cast<int>(unique_names(methods).size());
  Json chart = base_chart(kHead + kRowHeight * count);
  chart["data"] = {{"values", rows}};
  const Json colour = {{"field", "state"},
                       {"type", "nominal"},
                       {"title", nullptr},
                       {"scale", state_scale(states)},
                       {"legend", {{"columns", 4}, {"symbolType", "square"}}}};
  const Json border = {{"condition", {{"test", "datum.broken == 'yes'"}, {"value", "#000000"}}},
                       {"value", "#ffffff"}};
  Json cells = {{"mark", {{"type", "rect"}, {"strokeWidth", 1.2}}}};
  cells["encoding"] = {{"x", case_axis(numbers)},
                       {"y", method_axis(methods)},
                       {"color", colour},
                       {"stroke", border},
                       {"tooltip",
                        {tooltip("method", "method", ""), tooltip("case", "case", ""),
                         tooltip("state", "outcome", ""), tooltip("input", "put in", ""),
                         tooltip("output", "came out", ""), tooltip("required", "required", ""),
                         tooltip("amount", "amount", ""), tooltip("bound", "allowed", ""),
                         tooltip("claim", "claim", "")}}};
  chart["layer"] = Json::array({cells});
  return text_of(chart);
}

std::string matrix_finding(const StabilityResult& stability, const std::string& kind) {
  std::vector<StabilityRecord> of_kind;
  std::vector<std::string> failing;
  for (const StabilityRecord& record : stability.records) {
    if (record.kind != kind) continue;
    of_kind.push_back(record);
    if (!passes(record)) failing.push_back(record.method);
  }
  const StabilityTally tally = tally_of(of_kind);
  std::string text = fmt::format("{}: {} of {} claims kept", plural(kind), tally.passed,
                                 tally.passed + tally.broken);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  const std::size_t methods = unique_names(failing).size();
  if (methods == 0) return text + "; none fails anywhere";
  return fmt::format("{}; {} fail somewhere", text, counted(methods, "method"));
}

/// Whether the matrix of a kind has so many cases that a narrow window scrolls it.
bool has_many_cases(const StabilityResult& stability, const std::string& kind) {
  std::vector<std::string> numbers;
  for (const StabilityRecord& record : stability.records) {
    if (record.kind == kind) numbers.push_back(std::to_string(record.number));
  }
  return unique_names(numbers).size() > 6;
}

std::string cases_table(const StabilityResult& stability) {
  Table table("Hard inputs", {"Case", "Name", "Input", "Required", "Source"});
  for (const StabilityCaseRecord& row : stability.cases) {
    table.add({text_cell(std::to_string(row.number)),
               text_cell(row.name),
               {row.input, "detail", ""},
               {row.required, "detail", ""},
               {row.source, "detail", ""}});
  }
  return table.html();
}

std::string failures_table(const StabilityResult& stability) {
  Table table("What failed",
              {"Method", "Case", "Outcome", "Amount", "Allowed", "Put in", "Came out", "Claim"});
  for (const StabilityRecord& record : stability.records) {
    if (passes(record)) continue;
    table.add({text_cell(record.method),
               text_cell(case_name(stability, record.number)),
               text_cell(std::string(state_of(record))),
               number_cell(record.amount),
               number_cell(record.bound),
               {record.put_in, "detail", ""},
               {record.came_out, "detail", ""},
               text_cell(claim_of(record))});
  }
  return table.html();
}

/// Breaking points of one criterion.
using Points = std::vector<BreakingPoint>;

std::string breaking_chart(const Points& points) {
  Json rows = Json::array();
  std::vector<std::string> methods;
  const auto [low, high] = std::minmax(points.front().easiest, points.front().hardest);
  for (const BreakingPoint& point : points) {
    methods.push_back(point.method);
    const double passed = point.passed.value_or(point.easiest);
    const double failed = point.failed.value_or(point.hardest);
    rows.push_back({{"method", point.method},
                    {"passed", rounded(passed)},
                    {"failed", rounded(failed)},
                    {"easiest", rounded(point.easiest)},
                    {"series", point.failed ? "fails from here on" : "passes up to here"},
                    {"interval", interval_text(point)},
                    {"claim", point.known_defects ? "kept as published" : "corrected"}});
  }
  const std::vector<SeriesStyle> styles = {{"passes up to here", "#009e73", "triangle-right"},
                                           {"fails from here on", "#d55e00", "circle"}};
  const Json legend = {{"title", nullptr}};
  const auto along = [&](const char* field) {
    Json x = quantity(field, points.front().quantity + " (log)", "log");
    x["axis"] = log_axis(low, high);
    x["scale"]["domain"] = {low, high};
    x["scale"]["nice"] = false;
    x["scale"]["padding"] = 10;
    // The harder, the further to the right.
    if (points.front().hardest < points.front().easiest) x["scale"]["reverse"] = true;
    return x;
  };
  const Json y = method_axis(methods);
  const Json colour = series(styles, &SeriesStyle::colour, legend);
  const auto count = static_cast<int>(unique_names(methods).size());
  Json chart = base_chart(kHead + kRowHeight * count);
  chart["data"] = {{"values", rows}};
  const Json passing = {{"mark", {{"type", "rule"}, {"strokeWidth", 3}, {"opacity", 0.45}}},
                        {"encoding",
                         {{"y", y},
                          {"x", along("easiest")},
                          {"x2", {{"field", "passed"}}},
                          {"color", {{"value", "#009e73"}}}}}};
  const Json dots = {{"mark", {{"type", "point"}, {"filled", true}, {"size", 70}}},
                     {"encoding",
                      {{"y", y},
                       {"x", along("failed")},
                       {"color", colour},
                       {"shape", series(styles, &SeriesStyle::shape, legend)},
                       {"tooltip",
                        {tooltip("method", "method", ""), tooltip("interval", "first fails", ""),
                         tooltip("claim", "form", "")}}}}};
  chart["layer"] = {passing, dots};
  return text_of(chart);
}

std::string breaking_finding(const Points& points) {
  const auto failing = static_cast<std::size_t>(
      std::ranges::count_if(points, [](const BreakingPoint& p) { return p.failed.has_value(); }));
  return fmt::format("Against {}, {} of {} {} fail; required: {}", points.front().quantity, failing,
                     points.size(), plural(points.front().kind), points.front().criterion);
}

std::string breaking_table(const Points& points) {
  Table table("Breaking points", {"Method", "Quantity", "First fails"});
  for (const BreakingPoint& point : points) {
    table.add(
        {text_cell(point.method), text_cell(point.quantity), text_cell(interval_text(point))});
  }
  return table.html();
}

std::vector<Points> by_criterion(const Points& points) {
  std::vector<Points> groups;
  for (const BreakingPoint& point : points) {
    const auto same = [&](const Points& group) {
      return group.front().criterion == point.criterion &&
             group.front().quantity == point.quantity && group.front().kind == point.kind;
    };
    const auto group = std::ranges::find_if(groups, same);
    if (group == groups.end()) {
      groups.push_back({point});
    } else {
      group->push_back(point);
    }
  }
  return groups;
}

constexpr std::string_view kMatrixNote =
    "Each row is a method, each column a hard input; hover for what was put in, what came out and "
    "what is required. A black frame marks a claim that is not kept: methods that are kept as "
    "published, or cannot pass by their nature, make none.";

constexpr std::string_view kBreakingNote =
    "The input is made harder by doubling or halving until the method fails, then by bisection: "
    "the dot stands where it is known to fail, to 5 %, or 1 of whole numbers. Harder is to the "
    "right. A failure that is over before the next doubling is not seen.";

}  // namespace

std::string stability_section(const StabilityResult& stability) {
  std::string html = "<section id=\"stability\">\n<h2>What do hard inputs do?</h2>\n";
  if (stability.records.empty() && stability.breaking_points.empty()) {
    return html + paragraph("Hard inputs were not tried in this study.", "empty") + "</section>\n";
  }
  html += paragraph(stability_verdict(stability) + ".", "note");
  std::string note(kMatrixNote);
  const std::vector<std::string> kinds = kinds_of(stability.records);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    html += chart_figure({fmt::format("stability-{}", i),
                          matrix_finding(stability, kinds[i]),
                          fmt::format("Outcomes of hard inputs by method, of kind {}", kinds[i]),
                          note,
                          matrix_chart(stability, kinds[i]),
                          {},
                          has_many_cases(stability, kinds[i])},
                         i == 0 ? collapsible("Cases as a table", cases_table(stability)) : "");
    note.clear();
  }
  if (!stability.records.empty()) {
    html += collapsible("What failed, as a table", failures_table(stability)) +
            download_link("stability.csv", stability_csv(stability.records));
  }
  note = kBreakingNote;
  const std::vector<Points> groups = by_criterion(stability.breaking_points);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    html += chart_figure(
        {fmt::format("breaking-{}", i), breaking_finding(groups[i]),
         fmt::format("Where methods first fail as {} is made harder", groups[i].front().quantity),
         note, breaking_chart(groups[i])},
        collapsible("Breaking points as a table", breaking_table(groups[i])));
    note.clear();
  }
  if (!groups.empty()) {
    html += download_link("breaking-points.csv", breaking_points_csv(stability.breaking_points));
  }
  return html + "</section>\n";
}

}  // namespace lightproof
