#include "lightproof/history/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "lightproof/core/text_escapes.h"
#include "lightproof/page/numbers.h"
#include "lightproof/page/text_table.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;

/// Enough to tell commits apart where the whole name is elsewhere.
constexpr std::size_t kShortCommit = 12;
/// The most annotations of each level: GitHub shows ten a step.
constexpr std::size_t kAnnotations = 9;

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
      "and {} times the A/A noise, in two sessions; instructions: beyond +{} %; errors: beyond "
      "rounding, +{} %.",
      rule.alpha, 100.0 * rule.least_effect, rule.noise_factor, 100.0 * rule.instruction_effect,
      100.0 * rule.error_effect);
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

/// What one measurement of the latest session says.
std::string judgement_text(const ComparisonRow& row) {
  if (!row.latest) return to_string(row.metric);
  const Judgement& j = *row.latest;
  return fmt::format("{} instead of {} ({}, limit {}), {}", value_text(j.head, row.metric),
                     value_text(j.base, row.metric), change_text(j.ratio), change_text(j.limit),
                     to_string(row.metric));
}

/// Workflow commands of one level for the rows of one verdict.
std::string annotations(const Comparison& comparison, RowVerdict verdict, std::string_view level) {
  std::string text;
  std::size_t number = 0;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.verdict != verdict || ++number > kAnnotations) continue;
    text += fmt::format("::{} title={}::{}: {}\n", level,
                        workflow_property("lightproof: " + row.benchmark), to_string(verdict),
                        workflow_message(judgement_text(row)));
  }
  if (number <= kAnnotations) return text;
  return text + fmt::format("::{} title=lightproof::{} more {}: see the table\n", level,
                            counted(number - kAnnotations, "measurement"), to_string(verdict));
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  TextRows rows = {headings()};
  for (const ComparisonRow* row : ordered(comparison)) rows.push_back(cells_of(*row));
  std::string text = terminal_text(fmt::format("{} against {}", short_commit(comparison.head),
                                               short_commit(comparison.base))) +
                     "\n";
  for (const std::string& line : aligned_lines(rows)) text += line + "\n";
  text += fmt::format("\n{}\n{}\n{}\n", terminal_text(setting_text(comparison)),
                      rule_text(comparison), totals(comparison));
  const std::string more = advice(comparison);
  return more.empty() ? text : text + more + "\n";
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format("### Performance of {} against {}\n\n{}.\n\n|",
                                 markdown_text(short_commit(comparison.head)),
                                 markdown_text(short_commit(comparison.base)), totals(comparison));
  for (const std::string& name : headings()) text += fmt::format(" {} |", name);
  text += "\n|---|---|---|--:|--:|--:|--:|--:|--:|\n";
  for (const ComparisonRow* row : ordered(comparison)) {
    text += "|";
    for (const std::string& cell : cells_of(*row))
      text += fmt::format(" {} |", markdown_text(cell));
    text += "\n";
  }
  text += fmt::format("\n{} {}\n", rule_text(comparison), markdown_text(setting_text(comparison)));
  const std::string more = advice(comparison);
  return more.empty() ? text : text + "\n" + more + "\n";
}

std::string comparison_annotations(const Comparison& comparison) {
  return annotations(comparison, RowVerdict::regressed, "error") +
         annotations(comparison, RowVerdict::suspected, "warning");
}

std::string comparison_json(const Comparison& comparison, const RunDescription& run) {
  const RegressionRule& rule = comparison.rule;
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) {
    rows.push_back({{"benchmark", row.benchmark},
                    {"metric", to_string(row.metric)},
                    {"verdict", to_string(row.verdict)},
                    {"latest", json_of(row.latest)},
                    {"earlier", json_of(row.earlier)}});
  }
  const Json document = {{"format_version", kComparisonFormatVersion},
                         {"version", run.version},
                         {"commit", run.commit.empty() ? Json(nullptr) : Json(run.commit)},
                         {"command", run.command},
                         {"outcome", outcome_of(comparison)},
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
