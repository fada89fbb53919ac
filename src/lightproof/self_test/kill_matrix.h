// Which test kills which mutant, and with how many samples.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

struct KillOptions {
  std::uint64_t seed = 1;
  std::uint64_t usual = std::uint64_t{1} << 18U;  ///< the most samples that are tried
  /// The most samples that are tried on mutants that the oracle that they name has not rejected
  /// before, and by the sequential gate. Fewer than 2^12: no mutant is tried.
  std::uint64_t most = std::uint64_t{1} << 22U;

  static auto fields(auto& options) { return std::tie(options.seed, options.usual, options.most); }
};

/// Has every mutant of samplers under density B on mutant_map(), and every mutant of warps, judged
/// by the gate with 2^12, 2^14, … samples, and by the sequential gate. The same bits for any number
/// of processes, which share the mutants and all get the whole result.
std::vector<KillRecord> measure_kills(const KillOptions& options, const Progress& progress = {},
                                      const Communicator& communicator = {});

}  // namespace lightproof
