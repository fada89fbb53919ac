// Bands of rows in which the positions of samples inside their cells are judged together. The row
// of each pole is a band of its own: there alone do a density uniform in t and one uniform in
// cos(theta) differ by much, and there the fewest samples lie.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

struct RowBand {
  int first;     ///< row
  int last;      ///< likewise, at least the first
  double below;  ///< mass of all rows before the first
  double mass;
};

/// The first row, the last one, and up to three bands of as many rows as possible between them.
std::vector<RowBand> row_bands(std::span<const double> row_masses);

/// Equal cells of the share of the row's mass, and of the share of the cell's.
inline constexpr Extent kPositionCells = {8, 8};

}  // namespace lightproof
