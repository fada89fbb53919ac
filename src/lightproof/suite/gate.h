// The gate: every candidate against the law that it claims to draw, with one error probability for
// the whole run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/suite/results.h"
#include "lightproof/suite/subject.h"

namespace lightproof {

struct GateOptions {
  std::uint64_t samples = std::uint64_t{1} << 22U;  ///< per candidate
  std::uint64_t seed = 1;
  /// Probability that a run over correct samplers rejects anything.
  double family_alpha = 1e-6;
  /// Below this p-value a test is run again; below `at_once` it is rejected without.
  double suspicious = 1e-3;
  double at_once = 1e-10;
  /// The p-values (with run_sequential_gate: candidates) that share family_alpha, if they are more
  /// than this run has: the part of a run that is done again then judges as the whole did.
  std::uint64_t family = 0;
  /// The root mean square deviation of the bins, relative to their expectations, that an accepting
  /// run must have been able to see with kDetectablePower; else the test of the bins is
  /// inconclusive, and says how much it could have seen.
  double must_detect = kMustDetect;
};

/// Runs in two stages. After the first, a test whose p-value is below `at_once` (or half of
/// family_alpha shared out among all tests, if that is less) is rejected at once. One below
/// `suspicious` runs again with four times the samples and other random numbers, and Holm's
/// procedure over all tests of the family judges those at the other half; tests that did not run
/// again count as not rejected. Either way a correct sampler is rejected with at most
/// family_alpha; a small defect must look suspicious first and show with four times the samples
/// then. The same bits for any number of threads.
GateResult run_gate(std::span<const Problem> problems, const GateOptions& options,
                    const Progress& progress = {});

/// Every subject on every map.
GateResult run_gate(std::span<const EnvironmentMap> maps, std::span<const Subject> subjects,
                    const GateOptions& options, const Progress& progress = {});

/// Reject if any test that counts was rejected, else inconclusive if any was or none counts, else
/// resolution-limited if any was, else accept. Tests of samplers with known defects count only
/// where `count_known_defects` says so.
Outcome overall_outcome(const GateResult& result, bool count_known_defects);

}  // namespace lightproof
