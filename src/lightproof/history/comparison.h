// Two commits, benchmark by benchmark.
//
// A benchmark has regressed if the rule finds it slower in the two latest sessions that measured
// both commits: the second one is the confirming re-run. Slower in the latest alone, it is
// suspected. Two false alarms in a row at alpha = .001 come once in a million comparisons.
// Instruction counts and errors need no confirmation.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/history/rule.h"
#include "lightproof/history/run.h"

namespace lightproof {

/// What became of a benchmark from base to head.
enum class RowVerdict {
  same,
  regressed,
  suspected,
  unconfirmed,
  faster,
  only_in_base,
  only_in_head
};

/// The name of a verdict: "regressed", "suspected", …
const char* to_string(RowVerdict verdict);

/// One benchmark by two commits.
struct ComparisonRow {
  std::string benchmark;
  Metric metric = Metric::nanoseconds;
  RowVerdict verdict = RowVerdict::same;
  std::optional<Judgement> latest;   ///< none if only one commit has the benchmark
  std::optional<Judgement> earlier;  ///< what the session before says; none if there is none
};

/// Two commits, benchmark by benchmark.
struct Comparison {
  std::string base;  ///< the commit that head is compared with
  std::string head;  ///< the commit that may be slower
  std::string machine;
  std::string compiler;
  std::string flags;
  RegressionRule rule;
  std::vector<std::string> sessions;  ///< sessions that hold both commits, the latest last
  std::vector<ComparisonRow> rows;
};

/// Compares two commits, which may be given by their beginnings. Sessions on another machine, or by
/// another compiler or with other flags, than those of the latest one do not count. Throws
/// InputError if a commit is unknown or not unique, if no session holds both, if the runs of a
/// session differ in machine, compiler or flags, were not interleaved, or are too few for the rule.
Comparison compare(std::span<const BenchmarkRun> runs, const std::string& base,
                   const std::string& head, const RegressionRule& rule = {});

/// How many benchmarks have this verdict.
std::size_t count_of(const Comparison& comparison, RowVerdict verdict);

}  // namespace lightproof
