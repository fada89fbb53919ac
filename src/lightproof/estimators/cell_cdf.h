// Cumulative sums of a grid of weights in double, for tables that are made anew for every shading
// point: quick to make, and drawn from by bisection.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// The cell that was found in cumulative sums, and what is left of the random number.
struct FoundCell {
  std::size_t index;
  double rest;   ///< in [0,1)
  double width;  ///< the cell's weight
};

/// The first cell whose sum is above u times the last one; cells without weight are never found.
/// u is in [0,1), the last sum positive, and `before` what stands before the first one.
inline FoundCell find_cell(std::span<const double> sums, double before, double u) {
  const double whole = sums.back() - before;
  const double at = std::min(before + u * whole, std::nextafter(sums.back(), before));
  const auto found = std::upper_bound(sums.begin(), sums.end(), at);
  const auto index = static_cast<std::size_t>(found - sums.begin());
  const double low = index == 0 ? before : sums[index - 1];
  const double width = sums[index] - low;
  return {index, std::min((at - low) / width, 1.0 - 0x1p-53), width};
}

/// The distribution of cells in proportion to their weights, rows monotone in u.t, and
/// columns of a row in u.s.
class CellCdf {
 public:
  /// The weights are >= 0.
  explicit CellCdf(Grid<double> weights) : sums_(std::move(weights)) {
    double all = 0.0;
    for (int y = 0; y < sums_.extent().height; ++y) {
      double sum = 0.0;
      for (double& value : sums_.row(y)) value = sum += value;
      rows_.push_back(all += sum);
    }
  }

  double sum() const { return rows_.back(); }
  /// There must be a positive weight.
  TexelDraw draw(SquarePoint u) const {
    const FoundCell row = find_cell(rows_, 0.0, u.t);
    const auto y = static_cast<int>(row.index);
    const FoundCell column = find_cell(sums_.row(y), 0.0, u.s);
    return {static_cast<int>(column.index), y, column.rest, row.rest,
            row.width / sum() * (column.width / sums_.row(y).back())};
  }

 private:
  Grid<double> sums_;
  std::vector<double> rows_;
};

}  // namespace lightproof
