// Benchmarks over commits.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightproof/history/run.h"
#include "lightproof/stats/change_points.h"

namespace lightproof {

/// One commit's value of a benchmark.
struct TrendPoint {
  std::string commit;
  double value = 0.0;  ///< median over sessions of the medians over runs
  std::size_t runs = 0;
};

/// The values of one benchmark over commits, on one machine, by one compiler with one set of flags.
struct TrendLine {
  std::string machine;
  std::string compiler;
  std::string flags;
  std::string benchmark;
  Metric metric = Metric::nanoseconds;
  std::vector<TrendPoint> points;  ///< in the order in which the commits were first measured
  std::vector<ChangePoint> changes;
};

/// The lines of all benchmarks, and their changes. Changes of times are found by change_points(),
/// of all lines together, with a commit as one value: what runs of one session share, the state of
/// the machine, would pass for a change if runs were the values. That the machine's state lasts
/// from session to session is reckoned with. Instruction counts and errors change where a commit
/// differs from the one before by more than the limit of the regression rule. Runs come in the
/// order of their start.
std::vector<TrendLine> trend_lines(std::span<const BenchmarkRun> runs, const ChangeRule& rule = {});

}  // namespace lightproof
