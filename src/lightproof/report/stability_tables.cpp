#include "lightproof/report/stability_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "lightproof/page/numbers.h"
#include "lightproof/page/text_table.h"
#include "lightproof/report/csv_row.h"

namespace lightproof {
namespace {

std::string letter_of(const StabilityRecord& record) {
  switch (record.outcome) {
    case StabilityOutcome::right:
      return ".";
    case StabilityOutcome::wrong:
      return "W";
    case StabilityOutcome::not_a_number:
      return "N";
    case StabilityOutcome::out_of_range:
      return "O";
    case StabilityOutcome::refused:
      return record.may_refuse ? "r" : "R";
    case StabilityOutcome::not_applicable:
      return "-";
  }
  return "";
}

template <class Records, class Key>
std::vector<std::string> unique_of(const Records& records, const Key& key) {
  std::vector<std::string> all;
  for (const auto& record : records) {
    const std::string value = key(record);
    if (std::find(all.begin(), all.end(), value) == all.end()) all.push_back(value);
  }
  return all;
}

void append(std::vector<std::string>& lines, const TextRows& rows) {
  for (std::string& line : aligned_lines(rows)) lines.push_back(std::move(line));
  lines.emplace_back();
}

/// The matrix of one kind of method: numbers of cases on top.
TextRows matrix_of(const std::vector<StabilityRecord>& records, const std::string& kind) {
  std::vector<int> numbers;
  std::vector<std::string> methods;
  std::map<std::pair<std::string, int>, std::string> letters;
  for (const StabilityRecord& record : records) {
    if (record.kind != kind) continue;
    if (std::find(numbers.begin(), numbers.end(), record.number) == numbers.end()) {
      numbers.push_back(record.number);
    }
    if (std::find(methods.begin(), methods.end(), record.method) == methods.end()) {
      methods.push_back(record.method);
    }
    letters[{record.method, record.number}] = letter_of(record);
  }
  std::sort(numbers.begin(), numbers.end());
  TextRows rows = {{kind}};
  for (const int number : numbers) rows.front().push_back(std::to_string(number));
  for (const std::string& method : methods) {
    rows.push_back({method});
    for (const int number : numbers) rows.back().push_back(letters[{method, number}]);
  }
  return rows;
}

TextRows failures_of(const StabilityResult& stability) {
  TextRows rows = {{"case", "method", "outcome", "amount", "put in", "came out"}};
  for (const StabilityRecord& record : stability.records) {
    if (passes(record)) continue;
    const std::string why = record.known_defects   ? " (as published)"
                            : record.limit.empty() ? ""
                                                   : " (by its nature: " + record.limit + ")";
    rows.push_back({std::to_string(record.number), record.method, to_string(record.outcome),
                    significant(record.amount), record.put_in, record.came_out + why});
  }
  return rows;
}

TextRows breaking_rows(const std::vector<BreakingPoint>& points, const std::string& criterion) {
  TextRows rows;
  for (const BreakingPoint& point : points) {
    if (point.criterion == criterion) rows.push_back({"  " + point.method, interval_text(point)});
  }
  return rows;
}

/// Whole numbers, which searches find to 1, with all their digits.
std::string end_text(double value) {
  constexpr double kWrittenOut = 1e10;
  if (value == std::floor(value) && value < kWrittenOut) {
    return with_thousands(static_cast<std::uint64_t>(value));
  }
  return significant(value);
}

}  // namespace

StabilityTally tally_of(const std::vector<StabilityRecord>& records) {
  StabilityTally tally;
  for (const StabilityRecord& record : records) {
    if (record.outcome == StabilityOutcome::not_applicable) {
      ++tally.left_out;
    } else if (passes(record)) {
      ++tally.passed;
    } else if (breaks_claim(record)) {
      ++tally.broken;
    } else {
      ++tally.failed;
    }
  }
  return tally;
}

std::string interval_text(const BreakingPoint& point) {
  if (!point.failed) return fmt::format("none up to {}", end_text(point.hardest));
  if (!point.passed) return fmt::format("at {} already", end_text(*point.failed));
  return fmt::format("between {} and {}", end_text(*point.passed), end_text(*point.failed));
}

std::string stability_verdict(const StabilityResult& stability) {
  const StabilityTally tally = tally_of(stability.records);
  return fmt::format(
      "{} of {} claims kept, {} broken; {} failures that are published or in the nature of the "
      "method; {} not applicable",
      tally.passed, tally.passed + tally.broken, tally.broken, tally.failed, tally.left_out);
}

std::vector<std::string> stability_lines(const StabilityResult& stability) {
  std::vector<std::string> lines;
  const auto kind_of = [](const StabilityRecord& record) { return record.kind; };
  for (const std::string& kind : unique_of(stability.records, kind_of)) {
    append(lines, matrix_of(stability.records, kind));
  }
  lines.emplace_back(
      ". right   W wrong   N not a number   O out of range   r refused, as required   "
      "R refused   - not applicable");
  lines.emplace_back();
  TextRows cases = {{"case", "name", "input", "required"}};
  for (const StabilityCaseRecord& row : stability.cases) {
    cases.push_back({std::to_string(row.number), row.name, row.input, row.required});
  }
  append(lines, cases);
  const TextRows failures = failures_of(stability);
  if (failures.size() > 1) append(lines, failures);
  const auto criterion_of = [](const BreakingPoint& point) { return point.criterion; };
  for (const std::string& criterion : unique_of(stability.breaking_points, criterion_of)) {
    const auto found =
        std::ranges::find(stability.breaking_points, criterion, &BreakingPoint::criterion);
    lines.push_back(fmt::format("{} at which it first fails: {}", found->quantity, criterion));
    append(lines, breaking_rows(stability.breaking_points, criterion));
  }
  lines.push_back(stability_verdict(stability));
  return lines;
}

std::string stability_csv(const std::vector<StabilityRecord>& records) {
  using csv_parts::row;
  std::string csv = row("case", "kind", "method", "known_defects", "outcome", "passes", "amount",
                        "bound", "put_in", "came_out", "limit");
  for (const StabilityRecord& r : records) {
    csv += row(r.number, r.kind, r.method, r.known_defects ? "yes" : "no", to_string(r.outcome),
               passes(r) ? "yes" : "no", r.amount, r.bound, r.put_in, r.came_out, r.limit);
  }
  return csv;
}

std::string breaking_points_csv(const std::vector<BreakingPoint>& points) {
  using csv_parts::row;
  std::string csv = row("quantity", "criterion", "kind", "method", "known_defects", "easiest",
                        "hardest", "passed", "failed");
  for (const BreakingPoint& r : points) {
    csv += row(r.quantity, r.criterion, r.kind, r.method, r.known_defects ? "yes" : "no", r.easiest,
               r.hardest, r.passed, r.failed);
  }
  return csv;
}

}  // namespace lightproof
