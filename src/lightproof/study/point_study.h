// Point sets measured for the report: rates of convergence, discrepancies, decay in float.
#pragma once

#include <cstdint>

#include "lightproof/core/executor.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/points/integration_error.h"
#include "lightproof/results/point_study.h"

namespace lightproof {

struct PointStudyOptions {
  IntegrationOptions errors = {.counts = {16, 64, 256, 1024, 4096}, .seeds = 128, .seed = 1};
  /// Numbers of points whose discrepancies are computed, in a time that grows with their squares.
  std::vector<std::uint64_t> discrepancy_counts = {64, 256, 1024};
  std::uint64_t decay_window = 65536;
  int first_decay_power = 8;  ///< windows begin at 0 and at this power of 2, and all beyond
};

/// Every point set of the registry, on every integrand; the decay of those that are computed in
/// float. The number of threads, or of processes, which share the work, changes no bit.
PointStudy study_points(const PointStudyOptions& options = {}, const Progress& progress = {},
                        const Communicator& communicator = {});

/// The study of all point sets by a seed; or what is kept of it, of this program.
PointStudy kept_points(std::uint64_t seed, const MeasurementCache& cache,
                       const Progress& progress = {});

}  // namespace lightproof
