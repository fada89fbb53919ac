// A sampler of any masses, in double: what the mutants start from.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// A sampler of texels whose masses are given.
class DiscreteSampler {
 public:
  /// Samples texels of these masses, which sum to 1; inside a texel the position follows the
  /// density space.
  DiscreteSampler(Grid<double> masses, DensitySpace density_space);

  TexelSample sample(SquarePoint u) const;
  PerSquare pdf(SquarePoint at) const;
  std::size_t table_bytes() const;

  Extent extent() const { return masses_.extent(); }
  DensitySpace density_space() const { return positions_.density_space(); }
  const Grid<double>& masses() const { return masses_; }
  /// What u = (1/2, 1/2) gives: a texel with light.
  const TexelSample& median() const { return median_; }
  /// The mass below every row's upper edge; the last is 1.
  const std::vector<double>& rows() const { return rows_; }
  /// For each row the share of its mass to the left of every texel's right edge; 0 in a row without
  /// light.
  const Grid<double>& columns() const { return columns_; }

 private:
  Grid<double> masses_;
  TexelPositions positions_;
  std::vector<double> rows_;
  TexelSample median_;
  Grid<double> columns_;
};

}  // namespace lightproof
