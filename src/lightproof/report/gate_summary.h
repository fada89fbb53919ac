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
  std::string sampler_and_density;  ///< sampler_and_density() of its tests
  std::string sampler;
  std::string map;
  bool known_defect = false;
  Tally tally;
  const TestRecord* worst = nullptr;  ///< the worst test, in the GateResult; never null
};

/// The sampler and its density, "binary_search B"; the sampler alone where there is no density.
std::string sampler_and_density(const TestRecord& test);

/// The tests of a gate by run, in the order in which the runs first appear.
std::vector<GateCell> summarise(const GateResult& gate);

/// Whether the rejection is of a sampler that is kept as published, with its known defects.
bool is_known_defect(const GateResult& gate, const Rejection& rejection);

/// The part of a result that decides, and the part that shows known defects: tests and rejections.
struct SplitGate {
  GateResult deciding;
  GateResult known_defects;
};

/// The heading of what is shown of samplers with known defects.
inline constexpr std::string_view kDemonstration =
    "Kept as published, with known defects: demonstration, not part of the verdict";

/// Splits a result into what decides and what does not; all of it decides if `count_known_defects`.
SplitGate split_gate(const GateResult& gate, bool count_known_defects);

/// Samplers, with their densities, that were left out on a map for one reason.
struct LeftOutGroup {
  std::string map;
  std::string reason;
  std::vector<std::string> samplers;  ///< "alias B"
};

/// What was left out, grouped by map and reason, in the order of its first.
std::vector<LeftOutGroup> left_out_groups(const GateResult& gate);

/// One of the 32x16 bins over (phi, theta), and how far it is off in standard deviations.
struct WorstBin {
  int x;
  int y;
  double residual;
};

/// The bins that are farthest off, the worst first.
std::vector<WorstBin> worst_bins(const Rejection& rejection, std::size_t most);

/// An outcome in words, "✓ accept", "✗ reject", "? inconclusive", "≈ resolution-limited": a sign
/// and a word, so that colour is never needed.
std::string outcome_text(Outcome outcome);

}  // namespace lightproof
