// Sine and cosine of the angle at a position inside a cell of a row or a column. What belongs to
// the position alone is computed apart from what belongs to the cell, and the two are put together
// last: where the cell comes out of a table in memory, a processor does the first while it waits.
#pragma once

#include <cstddef>
#include <vector>

#include "lightproof/samplers/cell_margin.h"
#include "lightproof/warp/sin_cos.h"

namespace lightproof {

/// Equal cells that span an angle together.
class CellAngles {
 public:
  /// No cells.
  CellAngles() = default;
  /// `count` cells that span this share of a turn together; only the first `kept` of them are asked
  /// for.
  CellAngles(int count, double turns, int kept);

  /// Sine and cosine at `fraction` of the way through a cell, with errors of some 2^-52, where the
  /// first cell begins relative to the sine. Cells are counted from 0.
  SinCosOfTurns at(int cell, double fraction) const {
    if (!are_narrow_) return sin_cos_of_turns(position_in_cell(cell, fraction, cell_turns_));
    const SinCosOfTurns inside = sin_cos_of_small(inside_cell(fraction) * cell_radians_);
    const SinCosOfTurns& edge = edges_[static_cast<std::size_t>(cell)];
    return {edge.sin * inside.cos + edge.cos * inside.sin,
            edge.cos * inside.cos - edge.sin * inside.sin};
  }

  std::size_t bytes() const { return edges_.size() * sizeof(SinCosOfTurns); }

 private:
  double cell_turns_ = 1.0;
  double cell_radians_ = 1.0;
  bool are_narrow_ = false;           ///< so that sin_cos_of_small() serves
  std::vector<SinCosOfTurns> edges_;  ///< at the beginning of each cell; empty if cells are wide
};

}  // namespace lightproof
