// Positions inside a cell that keep a margin from its edges.
#pragma once

#include <algorithm>

namespace lightproof {

/// Fractions inside a cell keep this distance from its edges, so that no rounding moves a point to
/// the neighbour (up to 2^16 cells) or onto a pole.
inline constexpr double kCellMargin = 0x1p-34;

/// The fraction, or the nearest one that keeps the margin.
inline double inside_cell(double fraction) {
  return std::min(std::max(fraction, kCellMargin), 1.0 - kCellMargin);
}

/// The coordinate in [0,1) at `fraction` of the way through cell `index`; each cell is `size` wide.
inline double position_in_cell(int index, double fraction, double size) {
  return (index + inside_cell(fraction)) * size;
}

/// The coordinate in [0,1) at `fraction` of the way through cell `index` of `count` equal ones.
inline double position_in_cell(int index, double fraction, int count) {
  return position_in_cell(index, fraction, 1.0 / count);
}

}  // namespace lightproof
