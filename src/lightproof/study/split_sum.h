// What the split sum gets wrong on each map, over roughness and view angle.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/split_sum_record.h"

namespace lightproof {

/// What is gone through; every combination is a record.
struct SplitSumOptions {
  std::vector<double> roughness = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  std::vector<double> view_angles;  ///< in radians; empty: 0 to 80 degrees in steps of 10
  std::vector<double> normal_reflectances = {0.04, 1.0};
};

/// Map by map, then by reflectance, roughness and angle. The number of threads, or of processes,
/// which share the work, changes no bit. Throws std::logic_error if two maps have one name.
std::vector<SplitSumRecord> study_split_sum(std::span<const EnvironmentMap> maps,
                                            const SplitSumOptions& options = {},
                                            const Progress& progress = {},
                                            const Communicator& communicator = {});

}  // namespace lightproof
