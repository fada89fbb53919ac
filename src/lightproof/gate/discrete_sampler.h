// A sampler of any masses, in double: what the mutants start from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// Where bisection of cumulative shares begins and ends, by the first bits of the random number
/// (Chen and Asau 1974). Finds the cell that bisection of all of them would.
class ShareGuide {
 public:
  explicit ShareGuide(std::span<const double> sums);

  /// The first cell whose sum lies above u in [0,1), or the last cell; `sums` are those of the
  /// constructor.
  std::size_t find(std::span<const double> sums, double u) const;
  std::size_t bytes() const { return first_.size() * sizeof(std::uint32_t); }

 private:
  /// For every multiple of 1/parts, the cell that it lies in. Parts are a power of two, so that u
  /// times their number is exact.
  std::vector<std::uint32_t> first_;
};

/// A sampler of texels whose masses are given.
class DiscreteSampler {
 public:
  /// Samples texels of these masses, which sum to 1; inside a texel the position follows the
  /// density space.
  DiscreteSampler(Grid<double> masses, DensitySpace density_space)
      : DiscreteSampler(std::move(masses), lightproof::position_measure(density_space)) {}
  /// Samples texels of these masses, which sum to 1, at positions that are uniform in this measure.
  DiscreteSampler(Grid<double> masses, MapMeasure positions, const Mapping& mapping = {});

  TexelSample sample(SquarePoint u) const;
  PerSquare pdf(SquarePoint at) const;
  std::size_t table_bytes() const;

  Extent extent() const { return masses_.extent(); }
  /// The measure in which positions are uniform inside a texel.
  MapMeasure position_measure() const { return positions_.measure(); }
  const Mapping& mapping() const { return positions_.mapping(); }
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
  std::vector<ShareGuide> guides_;  ///< of every row's columns, and of the rows
};

}  // namespace lightproof
