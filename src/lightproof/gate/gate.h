// The gate: every instance against the distribution that it claims to draw, with one error
// probability for the whole run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/gate/test_run.h"
#include "lightproof/results/verdict.h"

namespace lightproof {

/// How the gate is run.
struct GateOptions {
  std::uint64_t samples = std::uint64_t{1} << 22U;  ///< samples of each instance
  std::uint64_t seed = 1;
  /// Probability that a run over correct samplers rejects anything.
  double family_alpha = 1e-6;
  /// The p-value below which a test is run again.
  double screening_level = 1e-3;
  /// The p-value below which a test is rejected without being run again.
  double immediate_level = 1e-10;
  /// The p-values (with run_sequential_gate: instances) that share family_alpha, if they are more
  /// than this run has: the part of a run that is done again then judges as the whole did.
  std::uint64_t family = 0;
  /// The root mean square deviation of the bins, relative to their expectations, that an accepting
  /// run must have been able to see with kDetectionPower; else the test of the bins is
  /// inconclusive, and says how much it could have seen.
  double must_detect = kMustDetect;
};

/// What the first stage found, by the keys of its runs: the same for the same samplers, samples and
/// seed, whatever else runs beside them.
using ScreenedRuns = CellResults<std::vector<Measured>>;

/// Runs the first stage of run_gate() alone.
ScreenedRuns screen_runs(std::span<const TestCase> test_cases, const GateOptions& options,
                         const Progress& progress = {}, const Communicator& communicator = {});

/// Runs the gate in two stages. After the first, a test whose p-value is below `immediate_level`
/// (or half of family_alpha shared out among all tests, if that is less) is rejected immediately.
/// One below `screening_level` runs again with four times the samples and other random numbers, and
/// Holm's procedure over all tests of the family judges those at the other half; tests that did not
/// run again count as not rejected. Either way a correct sampler is rejected with at most
/// family_alpha; a small defect must fall below the screening level first and show with four times
/// the samples then. The same bits for any number of threads or of processes, which share the runs
/// and all get the whole result. Throws std::logic_error if two runs have one sampler, map and
/// density by name: they would draw the same random numbers. Runs that `screened` holds, from
/// screen_runs() with the same options, are not screened again.
GateResult run_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                    const Progress& progress = {}, const Communicator& communicator = {},
                    const ScreenedRuns& screened = {});

/// Runs the gate on every sampler under test on every map.
GateResult run_gate(std::span<const EnvironmentMap> maps,
                    std::span<const SamplerUnderTest> samplers_under_test,
                    const GateOptions& options, const Progress& progress = {},
                    const Communicator& communicator = {});

}  // namespace lightproof
