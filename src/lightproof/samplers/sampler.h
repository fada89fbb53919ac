// What every environment-map sampler offers, and how its places inside a texel are chosen.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// Fractions inside a cell keep this distance from its edges, so that no rounding moves a point to
/// the neighbour (up to 2^16 cells) or onto a pole.
inline constexpr double kCellMargin = 0x1p-36;

/// The coordinate in [0,1) at `fraction` of cell `index` of `count`.
inline double place_in_cell(int index, double fraction, int count) {
  return (index + std::clamp(fraction, kCellMargin, 1.0 - kCellMargin)) / count;
}

/// Chooses t inside a row so that cos(theta) is uniform: equal solid angles are equally likely.
class SolidAngleRows {
 public:
  explicit SolidAngleRows(int height) : height_(height) {
    for (int edge = 0; edge <= height; ++edge) {
      const double sine = std::sin(0.5 * kPi * edge / height);
      squared_sines_.push_back(sine * sine);
    }
  }

  /// The t in row `y` below which lies the share `fraction` of the row's solid angle.
  /// sin^2(pi t / 2) is linear in the fraction; the row is mirrored to the lower half first, where
  /// its inverse loses no precision.
  double place(int y, double fraction) const {
    const bool upper = 2 * y >= height_;
    const int row = upper ? height_ - 1 - y : y;
    const double f = std::clamp(upper ? 1.0 - fraction : fraction, kCellMargin, 1.0 - kCellMargin);
    const double low = squared_sines_[static_cast<std::size_t>(row)];
    const double high = squared_sines_[static_cast<std::size_t>(row) + 1];
    const double sine = std::sqrt(low + f * (high - low));
    const double within = 2.0 / kPi * std::asin(std::min(sine, 1.0)) * height_ - row;
    return place_in_cell(y, upper ? 1.0 - within : within, height_);
  }

 private:
  int height_;
  std::vector<double> squared_sines_;  ///< of half the angle from the nadir, at the rows' edges
};

/// The row of t and the column of s; a coordinate of exactly 1 belongs to the last cell.
inline int cell_of(double coordinate, int count) {
  return std::clamp(static_cast<int>(coordinate * count), 0, count - 1);
}

}  // namespace lightproof
