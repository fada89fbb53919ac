// What it takes to prefilter a map: time and error by each method, and what a second thread gains.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// The fastest, the median and the slowest of some runs, in milliseconds.
struct TimeRange {
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;

  static auto fields(auto& r) { return std::tie(r.median, r.low, r.high); }
};

/// One method with one setting, making one level of one map.
struct LevelCost {
  std::string map;
  Extent map_extent;
  std::string level;  ///< "irradiance" or "GGX, roughness 0.5"
  Extent level_extent;
  std::string method;   ///< "importance sampling"
  std::string setting;  ///< "256 samples"; empty if there is nothing to set
  /// Root mean square of the difference from quadrature over that of the quadrature's values, at
  /// texels drawn in proportion to their solid angle.
  double error = 0.0;
  double error_low = 0.0;  ///< limits of its 95 % confidence interval
  double error_high = 0.0;
  std::size_t texels = 0;  ///< at which it was measured
  TimeRange milliseconds;

  static auto fields(auto& r) {
    return std::tie(r.map, r.map_extent.width, r.map_extent.height, r.level, r.level_extent.width,
                    r.level_extent.height, r.method, r.setting, r.error, r.error_low, r.error_high,
                    r.texels, r.milliseconds);
  }
};

/// Work on one thread and on two.
struct ThreadGain {
  std::string work;  ///< "irradiance, 64x32 normals"
  TimeRange one;     ///< milliseconds
  TimeRange two;
  /// Wall over processor time of the runs on one thread: 1 if the machine had nothing else to do.
  double wall_over_processor = 0.0;

  static auto fields(auto& r) { return std::tie(r.work, r.one, r.two, r.wall_over_processor); }
};

/// Both, and when, where and of what they were measured.
struct LevelCosts {
  std::vector<LevelCost> levels;
  std::vector<ThreadGain> gains;
  std::string origin;

  static auto fields(auto& costs) { return std::tie(costs.levels, costs.gains, costs.origin); }
};

}  // namespace lightproof
