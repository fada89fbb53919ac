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

/// How convergence is measured.
struct ConvergenceOptions {
  std::uint64_t seed = 1;
  /// The largest number N of samples; measured are N = 1, 4, 16, … up to it.
  std::uint64_t most_samples = 16384;
  /// The least number of independent estimates for every N, over all pixels of the receiver
  /// together.
  int estimates = 128;
  /// Extent of the receivers' pictures; their visible pixels are the points at which light is
  /// gathered.
  Extent picture = {8, 6};
};

/// Measures errors of independent estimates against quadrature, beside the exact variance, on every
/// map, receiver and material and by every estimator whose exact moments are known. The number of
/// threads, or of processes, which share the estimates, changes no bit. Throws std::logic_error if
/// two maps have one name.
std::vector<ConvergenceRecord> study_convergence(std::span<const EnvironmentMap> maps,
                                                 const ConvergenceOptions& options,
                                                 const Progress& progress = {},
                                                 const Communicator& communicator = {});

}  // namespace lightproof
