// How fast each estimator converges, and how well that was predicted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/convergence_record.h"

namespace lightproof {

struct ConvergenceOptions {
  std::uint64_t seed = 1;
  /// N = 1, 4, 16, … up to this.
  std::uint64_t most_samples = 16384;
  /// Independent estimates for every N, at least, over all pixels of the receiver together.
  int estimates = 128;
  /// The receivers' pictures; their visible pixels are the points at which light is gathered.
  Extent picture = {8, 6};
};

/// Every map, receiver and material, and every estimator whose exact moments are known: errors of
/// independent estimates against quadrature, beside the exact variance. The same bits for any
/// number of threads or of processes, which share the estimates. Throws std::logic_error if two
/// maps have one name.
std::vector<ConvergenceRecord> study_convergence(std::span<const EnvironmentMap> maps,
                                                 const ConvergenceOptions& options,
                                                 const Progress& progress = {},
                                                 const Communicator& communicator = {});

}  // namespace lightproof
