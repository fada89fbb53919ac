// The one rule by which outcomes of tests become a verdict; command line and report read it here.
#pragma once

#include <cstddef>
#include <string>

#include "lightproof/results/gate_result.h"

namespace lightproof {

/// Outcomes of a set of tests.
struct Tally {
  std::size_t tests = 0;
  std::size_t rejected = 0;
  std::size_t inconclusive = 0;
  std::size_t limited = 0;  ///< tests that are resolution-limited
  std::size_t not_run = 0;  ///< tests that were not run, which are not among `tests`

  void add(Outcome outcome);
  /// The outcome of the set: reject if any test rejects, else inconclusive if any is or there are
  /// none, else resolution-limited if any is, else accept.
  Outcome outcome() const;
};

/// The tally of the tests that `selected` returns true for.
template <class Selected>
Tally tally_of(const GateResult& gate, const Selected& selected) {
  Tally tally;
  for (const TestRecord& test : gate.tests) {
    if (selected(test)) tally.add(test.outcome);
  }
  return tally;
}

/// The tally of the tests that decide: those of samplers without known defects, or all of them.
Tally deciding_tally(const GateResult& gate, bool count_known_defects = false);

/// The tally of the tests of samplers that are kept as published, with their known defects.
Tally known_defect_tally(const GateResult& gate);

/// The verdict of a run: that of its deciding_tally().
Outcome overall_outcome(const GateResult& gate, bool count_known_defects);

/// What a tally says of tests that found nothing: ", 3 resolution-limited, 2 not run", or nothing.
std::string limited_text(const Tally& tally);

}  // namespace lightproof
