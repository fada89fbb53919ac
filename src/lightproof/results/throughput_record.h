// What samplers cost: time per sample, time to build, bytes; and the caches of the machine.
#pragma once

#include <optional>
#include <string>

#include "lightproof/core/grid.h"

namespace lightproof {

/// One row of the throughput benchmark.
struct ThroughputRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  double ns_per_sample = 0.0;  ///< median over repetitions
  double ns_low = 0.0;         ///< the smallest repetition
  double ns_high = 0.0;        ///< the largest repetition
  double table_bytes = 0.0;
  double build_ms = 0.0;  ///< median of some builds, on all threads
};

/// What a sampler's table costs and how well it keeps the map: a row of the benchmark of batches
/// with fused random numbers.
struct TableRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  double ns_per_sample = 0.0;  ///< median over repetitions
  double bytes_per_texel = 0.0;
  double worst_texel_error = 0.0;  ///< largest relative error of a texel's probability
  double times_baseline = 0.0;     ///< speed over that of std::upper_bound; 0 if it is that itself
  double share_of_limit = 0.0;     ///< speed over that of a bare gather; 0 if it is that itself
};

/// What a direction with its density per steradian costs, which is what a renderer asks for: a row
/// of the benchmark of directions.
struct DirectionRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  std::string density;  ///< "A", "B" or "C"
  /// "scalar": one at a time, at random points that are given. "fused": in batches, random numbers
  /// included.
  std::string order;
  double ns_per_sample = 0.0;   ///< median over repetitions
  double times_baseline = 0.0;  ///< speed over that of the usual way; 0 if it is that itself
  /// Speed over that of a bare gather with a square root, a sine and a cosine; 0 if it is that
  /// itself, or one at a time.
  double share_of_limit = 0.0;
};

/// Sizes in bytes of the caches that a core of the measured machine reads through, as its system
/// reports them; empty where it does not.
struct CacheSizes {
  std::optional<double> l2;
  std::optional<double> l3;
};

}  // namespace lightproof
