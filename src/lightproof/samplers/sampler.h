// What every environment-map sampler offers.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// One drawn point. A sound sampler keeps `at` strictly inside its texel and pdf > 0; a published
/// one may leave the map (x = width, y = height, not a number), which the gate reports.
struct TexelSample {
  SquarePoint at;
  std::int32_t x;
  std::int32_t y;
  PerSquare pdf;
};

/// A sampler maps uniform points of the square to points of the map. Immutable once built.
template <class T>
concept EnvSampler = requires(const T sampler, SquarePoint point) {
  { sampler.sample(point) } -> std::same_as<TexelSample>;
  { sampler.pdf(point) } -> std::same_as<PerSquare>;
  { sampler.table_bytes() } -> std::same_as<std::size_t>;
};

/// The row of t and the column of s; a coordinate of exactly 1 belongs to the last cell.
inline int cell_of(double coordinate, int count) {
  return std::clamp(static_cast<int>(coordinate * count), 0, count - 1);
}

}  // namespace lightproof
