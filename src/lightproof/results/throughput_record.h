// What samplers cost: time per sample, time to build, bytes; and the caches of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "lightproof/core/enumeration.h"
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
  double build_ms = 0.0;      ///< median of some builds, on all threads
  double wall_per_cpu = 1.0;  ///< wall time over processor time, median over repetitions

  static auto fields(auto& row) {
    return std::tie(row.sampler, row.map, row.extent.width, row.extent.height, row.ns_per_sample,
                    row.ns_low, row.ns_high, row.table_bytes, row.build_ms, row.wall_per_cpu);
  }
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
  double wall_per_cpu = 1.0;       ///< wall time over processor time, median over repetitions

  static auto fields(auto& row) {
    return std::tie(row.sampler, row.map, row.extent.width, row.extent.height, row.ns_per_sample,
                    row.bytes_per_texel, row.worst_texel_error, row.times_baseline,
                    row.share_of_limit, row.wall_per_cpu);
  }
};

/// In which order directions are asked for.
enum class DrawOrder { scalar, ahead, batch, fused };

template <>
inline constexpr std::size_t kValuesOf<DrawOrder> = 4;

struct DrawOrderInfo {
  std::string_view name;   ///< in the names of benchmarks, and in JSON
  std::string_view words;  ///< in reports
};

/// The orders, by their values.
inline constexpr std::array<DrawOrderInfo, 4> kDrawOrders = {
    {{"scalar", "one at a time"},
     {"ahead", "one at a time, begun ahead"},
     {"batch", "in batches, at given points"},
     {"fused", "in batches, random numbers included"}}};

inline const DrawOrderInfo& describe(DrawOrder order) {
  return kDrawOrders[static_cast<std::size_t>(order)];
}

/// What a direction with its density per steradian costs, which is what a renderer asks for: a row
/// of the benchmark of directions.
struct DirectionRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  std::string density;  ///< "A", "B" or "C"
  /// All but `fused` draw at random points that are given; `ahead` begins each sample eight
  /// samples before it is finished.
  DrawOrder order = DrawOrder::scalar;
  double ns_per_sample = 0.0;   ///< median over repetitions
  double times_baseline = 0.0;  ///< speed over that of the usual way; 0 if it is that itself
  /// Speed over that of a bare gather with a square root, a sine and a cosine; 0 if it is that
  /// itself, or of another order than `fused`.
  double share_of_limit = 0.0;
  double wall_per_cpu = 1.0;  ///< wall time over processor time, median over repetitions

  static auto fields(auto& row) {
    return std::tie(row.sampler, row.map, row.extent.width, row.extent.height, row.density,
                    row.order, row.ns_per_sample, row.times_baseline, row.share_of_limit,
                    row.wall_per_cpu);
  }
};

/// Sizes in bytes of the caches that a core of the measured machine reads through, as its system
/// reports them; empty where it does not.
struct CacheSizes {
  std::optional<double> l2;
  std::optional<double> l3;

  static auto fields(auto& caches) { return std::tie(caches.l2, caches.l3); }
};

}  // namespace lightproof
