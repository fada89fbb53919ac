// Inversion of a CdfTable: first the row, then the column in it. What differs between methods is
// only how the cell is searched; for the same point all of them return the same texel.
#pragma once

#include <cstdint>

#include "lightproof/samplers/cdf_table.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// A search returns the first cell whose upper knot lies above `u`, u < kCdfOne. Cells without
/// mass are never returned.
using CellSearch = int (*)(CdfKnots knots, std::uint32_t u);

/// An inversion sampler with the given search. Monotone: it keeps stratification.
template <CellSearch kSearch>
class CdfInversion {
 public:
  CdfInversion(const EnvironmentMap& map, TargetDensity target)
      : table_(map, target), solid_angle_rows_(table_.extent().height) {}

  TexelSample sample(SquarePoint u) const {
    const Cell row = find(table_.rows(), u.t);
    const Cell column = find(table_.columns(row.index), u.s);
    const Extent extent = table_.extent();
    const double t = table_.weighting() == Weighting::A
                         ? place_in_cell(row.index, row.fraction, extent.height)
                         : solid_angle_rows_.place(row.index, row.fraction);
    const SquarePoint at = {place_in_cell(column.index, column.fraction, extent.width), t};
    return {at, column.index, row.index, table_.pdf(column.index, row.index, at)};
  }

  PerSquare pdf(SquarePoint at) const {
    return table_.pdf(cell_of(at.s, table_.extent().width), cell_of(at.t, table_.extent().height),
                      at);
  }

  const CdfTable& table() const { return table_; }
  std::size_t table_bytes() const { return table_.bytes(); }

 private:
  struct Cell {
    int index;
    double fraction;  ///< of the way through the cell's mass, in [0,1)
  };

  static Cell find(CdfKnots knots, double u) {
    const double scaled = u * kCdfOne;
    const int index = kSearch(knots, static_cast<std::uint32_t>(scaled));
    const std::uint32_t low = knots[static_cast<std::size_t>(index)];
    const std::uint32_t high = knots[static_cast<std::size_t>(index) + 1];
    return {index, (scaled - low) / (high - low)};
  }

  CdfTable table_;
  SolidAngleRows solid_angle_rows_;
};

}  // namespace lightproof
