// The gate, tested on itself: are its p-values what they say, and is a whole run wrong as rarely as
// it promises?
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// How the calibration of p-values is measured.
struct CalibrationOptions {
  std::uint64_t seed = 1;
  std::uint64_t replicates = 10000;  ///< p-values for each test
  std::uint64_t samples = 4096;      ///< behind each p-value
  std::uint64_t runs = 1000;         ///< whole runs of the gate
  std::uint64_t run_samples = 4096;  ///< samples of each such run
  double family_alpha = 0.05;        ///< scaled up, so that false alarms can be counted
  double screening_level = 0.3;      ///< scaled up: at 1e-3 hardly a run has a second stage

  static auto fields(auto& options) {
    return std::tie(options.seed, options.replicates, options.samples, options.runs,
                    options.run_samples, options.family_alpha, options.screening_level);
  }
};

/// Draws from a distribution whose masses are known to the last bit, by inversion in double, and
/// keeps what the gate's tests make of it. The same bits for any number of threads or of processes,
/// which share the replicates and all get the whole result.
CalibrationResult calibrate(const CalibrationOptions& options, const Progress& progress = {},
                            const Communicator& communicator = {});

}  // namespace lightproof
