// Directions on a grid of the map, row by row, from one table per column and one per row: what k is
// tabulated at.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/materials/material_batch.h"

namespace lightproof {

/// The size of a cell of a grid in s and in t.
struct CellSize {
  double s;
  double t;
};

/// The size of the cells of an even grid over the whole map.
inline CellSize cell_size(Extent extent) { return {1.0 / extent.width, 1.0 / extent.height}; }

/// The directions at s = (x + fraction) size.s, t = (y + fraction) size.t, which is at most 1.
class TexelDirections {
 public:
  /// Directions at this fraction, in [0,1], of the width and the height of each cell: 1/2 are the
  /// centres, 0 the corners.
  TexelDirections(CellSize size, double fraction, Extent count);

  int columns() const { return static_cast<int>(cosine_.size()); }
  int rows() const { return static_cast<int>(height_.size()); }
  std::size_t bytes() const { return 2 * (cosine_.size() + height_.size()) * sizeof(double); }

  Direction at(int x, int y) const {
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    return {radius_[row] * cosine_[column], radius_[row] * sine_[column], height_[row]};
  }
  /// k of the directions of one row.
  void reflected(const Material& material, const ShadingPoint& at, int row,
                 std::span<double> k) const;

 private:
  std::vector<double> cosine_;  ///< of the azimuth of each column
  std::vector<double> sine_;
  std::vector<double> height_;  ///< z of each row
  std::vector<double> radius_;  ///< distance of each row from the axis
};

}  // namespace lightproof
