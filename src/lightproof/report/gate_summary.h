// The tests of a gate counted by run (a sampler, a density and a map); tables, pages and sentences
// all start from here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightproof/results/verdict.h"

namespace lightproof {

/// All tests of one sampler, density and map.
struct GateCell {
  std::string sampler_and_density;  ///< see sampler_and_density()
  std::string sampler;
  std::string map;
  bool known_defect = false;
  Tally tally;
  const TestRecord* worst = nullptr;  ///< points into the GateResult; never null
};

/// "binary_search B"; the sampler alone where there is no density.
std::string sampler_and_density(const TestRecord& test);

/// In the order in which the runs first appear.
std::vector<GateCell> summarise(const GateResult& gate);

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

}  // namespace lightproof
