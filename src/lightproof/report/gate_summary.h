// The tests of a gate counted by configuration; tables, pages and sentences all start from here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightproof/suite/results.h"

namespace lightproof {

/// Outcomes of a set of tests.
struct Tally {
  std::size_t tests = 0;
  std::size_t rejected = 0;
  std::size_t inconclusive = 0;
  std::size_t limited = 0;  ///< by resolution
  std::size_t not_run = 0;  ///< not among `tests`

  void add(Outcome outcome);
  /// Reject if any test rejects, else inconclusive if any is or there are none, else
  /// resolution-limited if any is, else accept.
  Outcome outcome() const;
};

/// All tests of one sampler, weighting and map.
struct GateCell {
  std::string configuration;  ///< see configuration_name
  std::string sampler;
  std::string map;
  bool known_defect = false;
  Tally tally;
  const TestRecord* worst = nullptr;  ///< points into the GateResult; never null
};

/// "binary_search B"; the sampler alone where there is no weighting.
std::string configuration_name(const TestRecord& test);

/// In the order in which the configurations first appear.
std::vector<GateCell> summarise(const GateResult& gate);

/// The tally of the tests that `selected` returns true for.
template <class Selected>
Tally tally_of(const GateResult& gate, const Selected& selected) {
  Tally tally;
  for (const TestRecord& test : gate.tests) {
    if (selected(test)) tally.add(test.outcome);
  }
  return tally;
}

/// ", 3 resolution-limited, 2 not run", or nothing.
std::string limited_text(const Tally& tally);

/// The tests that decide: those of samplers without known defects.
Tally deciding_tally(const GateResult& gate);

/// The tests of samplers that are kept as published, with their known defects.
Tally known_defect_tally(const GateResult& gate);

/// Whether the rejection is of a sampler that is kept as published, with its known defects.
bool is_known_defect(const GateResult& gate, const Rejection& rejection);

/// The part of a result that decides, and the part that shows known defects: tests and rejections.
struct SplitGate {
  GateResult deciding;
  GateResult known_defects;
};

/// Heads what is shown of samplers with known defects.
inline constexpr std::string_view kDemonstration =
    "Kept as published, with known defects: demonstration, not part of the verdict";

/// All of it decides if `count_known_defects`.
SplitGate split_gate(const GateResult& gate, bool count_known_defects);

/// A bin of the 16x32 and how far it is off, in standard deviations.
struct WorstBin {
  int x;
  int y;
  double residual;
};

/// The bins that are farthest off, the worst first.
std::vector<WorstBin> worst_bins(const Rejection& rejection, std::size_t most);

/// "✓ accept", "✗ reject", "? inconclusive", "≈ resolution-limited": a sign and a word, so that
/// colour is never needed.
std::string outcome_text(Outcome outcome);

/// The names in order of first appearance, each once.
std::vector<std::string> unique_names(const std::vector<std::string>& names);

}  // namespace lightproof
