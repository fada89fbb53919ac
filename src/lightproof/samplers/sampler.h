// What every environment-map sampler offers.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// One drawn point. A correct sampler keeps `at` strictly inside its texel and pdf > 0; a published
/// one may leave the map (x = width, y = height, not a number), which the gate reports.
struct TexelSample {
  SquarePoint at;
  std::int32_t x;
  std::int32_t y;
  PerSquare pdf;
};

/// A drawn direction: a unit vector in the map's frame, with its density per steradian and the
/// texel that it lies in.
struct LightSample {
  Direction direction;
  PerSteradian pdf;
  std::int32_t x;
  std::int32_t y;
};

/// A texel that was drawn with probability `mass`, and what is left of the two random numbers: the
/// sample's position in the texel as uniform shares in [0,1) of its width and of its height (under
/// B: of its solid angle).
struct TexelDraw {
  int x;
  int y;
  double column_fraction;
  double row_fraction;
  double mass;
};

/// The number itself, or the largest below 1 if it is 1, which is no random number of [0,1), but
/// what generators of floats round up to: float(uint32) 2^-32 once in 3e7 numbers. Every sampler
/// takes it for the last number.
inline double below_one(double number) { return std::min(number, 1.0 - 0x1p-53); }
inline SquarePoint below_one(SquarePoint u) { return {below_one(u.s), below_one(u.t)}; }

/// A sampler maps uniform points of the square to points of the map; a coordinate of exactly 1
/// counts as the last one below. Immutable once built.
template <class T>
concept EnvSampler = requires(const T sampler, SquarePoint point) {
  { sampler.sample(point) } -> std::same_as<TexelSample>;
  { sampler.pdf(point) } -> std::same_as<PerSquare>;
  { sampler.table_bytes() } -> std::same_as<std::size_t>;
};

/// The cell, of `count` equal ones over [0,1], that a coordinate lies in: the row of t or the
/// column of s. A coordinate of exactly 1 belongs to the last cell. What lies outside of [0,1]
/// belongs to the nearer end, infinities too, and what is not a number to cell 0: whoever must tell
/// these apart looks at the coordinate.
inline int cell_of(double coordinate, int count) {
  // Both in this order: a comparison with what is not a number is false, and std::max then returns
  // its first argument. Converted to an integer before, it would be undefined.
  const double cell = std::max(0.0, coordinate * count);
  return static_cast<int>(std::min(cell, static_cast<double>(count - 1)));
}

}  // namespace lightproof
