// Time against error of every way to prefilter a map, and what a second thread gains.
#pragma once

#include <span>

#include "lightproof/core/grid.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/level_cost.h"
#include "lightproof/results/map_record.h"

namespace lightproof {

struct LevelCostOptions {
  std::size_t threads = 1;  ///< that the levels are made on
  Extent level = {64, 32};  ///< of the levels that are made
  std::size_t texels = 64;  ///< of a level, at which its error is measured
  int runs = 3;             ///< of every method, at least 1, one after the other in turns
  /// The size of the map that gains of a thread are measured on; the sizes of what is made of it
  /// follow.
  Extent gain_map = {512, 256};
};

/// Irradiance and a GGX level of every map, by every method of prefilter/ with some settings: each
/// once to warm up and to measure its error by, then in turns. Errors are those of 64-bit
/// quadrature at texels drawn at random, which depend on the map alone; below some 1e-5 they are
/// the quadrature's own.
std::vector<LevelCost> measure_level_costs(const EnvironmentMap& map,
                                           const LevelCostOptions& options);

/// An irradiance map, a GGX chain and a BRDF map of a built-in map, on one thread and on two, in
/// turns.
std::vector<ThreadGain> measure_thread_gains(const LevelCostOptions& options);

/// Both, for all maps; or what is kept of them, of this program, machine and map.
LevelCosts kept_level_costs(std::span<const MapRecord> maps, const LevelCostOptions& options,
                            const MeasurementCache& cache, const Progress& progress = {});

}  // namespace lightproof
