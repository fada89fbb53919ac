// The gate, tested on itself: does it see what it says that it would see?
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// How power is measured.
struct PowerOptions {
  std::uint64_t seed = 1;
  std::uint64_t replicates = 1000;  ///< replicates of each record

  static auto fields(auto& options) { return std::tie(options.seed, options.replicates); }
};

/// Injects defects as large as the gate says that it detects, and lets it judge them with both of
/// its stages, or sequentially: how often it rejects, which should be at least kDetectionPower. The
/// same bits for any number of processes, which share the replicates and all get the whole result.
std::vector<PowerRecord> measure_printed_effects(const PowerOptions& options,
                                                 const Progress& progress = {},
                                                 const Communicator& communicator = {});

/// The tests that print an effect: measure_printed_effects has a record of each.
std::vector<TestId> printed_effects();

/// Lets a distribution a little off be judged with several numbers of samples, some too few: how
/// often each test rejects, and how often it should. The same bits for any number of processes,
/// which share the replicates and all get the whole result.
std::vector<PowerRecord> measure_power(const PowerOptions& options, const Progress& progress = {},
                                       const Communicator& communicator = {});

}  // namespace lightproof
