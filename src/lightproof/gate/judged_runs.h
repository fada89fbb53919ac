// The end of every gate: the records of its runs, and a diagnosis of what they reject.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/gate/by_run.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/expectations.h"
#include "lightproof/results/gate_result.h"

namespace lightproof {

/// What a diagnosis needs of a run beside its records.
struct DrawnRun {
  Draws draws;
  Inspection inspection;
};

/// The runs of a gate, their records judged.
struct JudgedRuns {
  std::span<const TestCase> test_cases;
  std::uint64_t seed;
  ByRun<std::vector<TestRecord>>& records;
  /// What was drawn for a run that is rejected: as this process kept it, or the same samples once
  /// more. Called once for each at the most.
  std::function<DrawnRun(RunIndex, const Expectation&)> drawn;
};

bool is_any_rejected(std::span<const TestRecord> records);

/// Adds the records of all runs, in their order, and the diagnoses of those that are rejected. A
/// cell of work is a test case, whose runs are diagnosed together.
void add_judged(GateResult& result, const JudgedRuns& runs, Expectations& expectations,
                const Communicator& communicator);

}  // namespace lightproof
