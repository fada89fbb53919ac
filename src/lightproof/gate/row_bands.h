// Bands of rows in which the positions of samples inside their cells are judged together. The row
// of each pole is a band of its own: there alone do a density uniform in t and one uniform in
// cos(theta) differ by much, and there the fewest samples lie.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// Neighbouring rows.
struct RowBand {
  int first;     ///< first row
  int last;      ///< last row, at least the first
  double below;  ///< probability of all rows before the first
  double mass;   ///< probability of the band
};

/// The bands of rows of these probabilities: the first row, the last one, and up to three bands, of
/// numbers of rows as equal as possible, between them.
std::vector<RowBand> row_bands(std::span<const double> row_masses);

/// The equal cells in which positions are counted: of the share of the cell's mass to the left
/// (conditional) and of the share of the row's mass below (marginal).
inline constexpr Extent kPositionCells = {8, 8};

}  // namespace lightproof
