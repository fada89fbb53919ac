#include "lightproof/history/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "lightproof/report/columns.h"
#include "lightproof/report/numbers.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;

/// Enough to tell commits apart where the whole name is elsewhere.
constexpr std::size_t kShortCommit = 12;

std::string short_commit(const std::string& commit) {
  const bool hash = commit.find_first_not_of("0123456789abcdef") == std::string::npos;
  return hash ? commit.substr(0, kShortCommit) : commit;
}

/// Rows by urgency, then by name.
std::vector<const ComparisonRow*> ordered(const Comparison& comparison) {
  const auto urgency = [](RowVerdict verdict) {
    switch (verdict) {
      case RowVerdict::regressed:
        return 0;
      case RowVerdict::suspected:
        return 1;
      case RowVerdict::unconfirmed:
        return 2;
      case RowVerdict::faster:
        return 3;
      default:
        return 4;
    }
  };
  std::vector<const ComparisonRow*> rows;
  for (const ComparisonRow& row : comparison.rows) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(), [&](const auto* a, const auto* b) {
    return urgency(a->verdict) < urgency(b->verdict);
  });
  return rows;
}

std::string change_text(double ratio) { return fmt::format("{:+.1f} %", 100.0 * (ratio - 1.0)); }

std::string value_text(double value, Metric metric) {
  return significant(value, 4) + (metric == Metric::nanoseconds ? " ns" : "");
}

std::vector<std::string> cells_of(const ComparisonRow& row) {
  std::vector<std::string> cells = {to_string(row.verdict), row.benchmark, to_string(row.metric)};
  if (!row.latest) {
    cells.insert(cells.end(), {"-", "-", "-", "-", "-", "-"});
    return cells;
  }
  const Judgement& j = *row.latest;
  const bool timed = row.metric == Metric::nanoseconds;
  cells.insert(cells.end(), {value_text(j.base, row.metric), value_text(j.head, row.metric),
                             change_text(j.ratio), change_text(j.limit),
                             timed ? significant(100.0 * j.noise, 2) + " %" : "-",
                             j.log10_p ? significant(*j.log10_p) : "exact"});
  return cells;
}

const std::vector<std::string>& headings() {
  static const std::vector<std::string> names = {
      "verdict", "benchmark", "metric", "base", "head", "change", "limit", "A/A noise", "log10 p"};
  return names;
}

std::string outcome_of(const Comparison& comparison) {
  if (count_of(comparison, RowVerdict::regressed) > 0) return "regressed";
  return count_of(comparison, RowVerdict::suspected) > 0 ? "suspected" : "passed";
}

std::string totals(const Comparison& comparison) {
  const auto count = [&](RowVerdict verdict) { return count_of(comparison, verdict); };
  return fmt::format("{}: {} of {} regressed, {} suspected, {} not confirmed, {} faster",
                     outcome_of(comparison), count(RowVerdict::regressed),
                     counted(comparison.rows.size(), "measurement"), count(RowVerdict::suspected),
                     count(RowVerdict::unconfirmed), count(RowVerdict::faster));
}

/// What to do about suspicions; empty if there are none.
std::string advice(const Comparison& comparison) {
  if (count_of(comparison, RowVerdict::suspected) == 0) return "";
  return "Suspected is slower in one session only: measure both commits again, interleaved, and "
         "add the files as another session.";
}

std::string rule_text(const Comparison& comparison) {
  const RegressionRule& rule = comparison.rule;
  return fmt::format(
      "Slower: one-sided Mann-Whitney p <= {} and a median beyond the limit, the larger of +{} % "
      "and {} times the A/A noise, in two sessions; instructions: beyond +{} %.",
      rule.alpha, 100.0 * rule.least_effect, rule.noise_factor, 100.0 * rule.instruction_effect);
}

std::string setting_text(const Comparison& comparison) {
  return fmt::format("{}; {}; {}; {}", comparison.machine, comparison.compiler, comparison.flags,
                     counted(comparison.sessions.size(), "session"));
}

Json json_of(const std::optional<Judgement>& j) {
  if (!j) return nullptr;
  const char* change = j->change == Change::none     ? "none"
                       : j->change == Change::slower ? "slower"
                                                     : "faster";
  return {{"base", j->base},           {"head", j->head},
          {"base_runs", j->base_runs}, {"head_runs", j->head_runs},
          {"ratio", j->ratio},         {"limit", j->limit},
          {"noise", j->noise},         {"log10_p", j->log10_p ? Json(*j->log10_p) : Json(nullptr)},
          {"change", change}};
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  TextRows rows = {headings()};
  for (const ComparisonRow* row : ordered(comparison)) rows.push_back(cells_of(*row));
  std::string text =
      fmt::format("{} against {}\n", short_commit(comparison.head), short_commit(comparison.base));
  for (const std::string& line : aligned_lines(rows)) text += line + "\n";
  text += fmt::format("\n{}\n{}\n{}\n", setting_text(comparison), rule_text(comparison),
                      totals(comparison));
  const std::string more = advice(comparison);
  return more.empty() ? text : text + more + "\n";
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format("### Performance of {} against {}\n\n{}.\n\n|",
                                 markdown_cell(short_commit(comparison.head)),
                                 markdown_cell(short_commit(comparison.base)), totals(comparison));
  for (const std::string& name : headings()) text += fmt::format(" {} |", name);
  text += "\n|---|---|---|--:|--:|--:|--:|--:|--:|\n";
  for (const ComparisonRow* row : ordered(comparison)) {
    text += "|";
    for (const std::string& cell : cells_of(*row))
      text += fmt::format(" {} |", markdown_cell(cell));
    text += "\n";
  }
  text += fmt::format("\n{} {}\n", rule_text(comparison), markdown_cell(setting_text(comparison)));
  const std::string more = advice(comparison);
  return more.empty() ? text : text + "\n" + more + "\n";
}

std::string comparison_json(const Comparison& comparison) {
  const RegressionRule& rule = comparison.rule;
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) {
    rows.push_back({{"benchmark", row.benchmark},
                    {"metric", to_string(row.metric)},
                    {"verdict", to_string(row.verdict)},
                    {"latest", json_of(row.latest)},
                    {"earlier", json_of(row.earlier)}});
  }
  const Json document = {{"outcome", outcome_of(comparison)},
                         {"base", comparison.base},
                         {"head", comparison.head},
                         {"machine", comparison.machine},
                         {"compiler", comparison.compiler},
                         {"flags", comparison.flags},
                         {"sessions", comparison.sessions},
                         {"rule",
                          {{"alpha", rule.alpha},
                           {"least_effect", rule.least_effect},
                           {"noise_factor", rule.noise_factor},
                           {"instruction_effect", rule.instruction_effect}}},
                         {"rows", rows}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
