// Jittered points (Cook, Porter and Carpenter 1984): one in each cell of a grid, uniform inside.
#pragma once

#include <cassert>
#include <cstdint>

#include "lightproof/core/random.h"
#include "lightproof/points/point_set.h"

namespace lightproof {

/// The grid has N cells, as nearly square as N's divisors allow; of a prime number it is one row.
/// Cells are passed row by row.
class StratifiedPoints {
 public:
  /// The count N is in [1, 2^32].
  StratifiedPoints(std::uint64_t count, PointSeed seed);

  /// The index is below N.
  SquarePoint point(std::uint32_t index) const {
    assert(index < columns_ * rows_);
    const SquarePoint inside = stream_.point(index);
    return {in_stratum(index % columns_, inside.s, columns_),
            in_stratum(index / columns_, inside.t, rows_)};
  }

  std::uint64_t columns() const { return columns_; }
  std::uint64_t rows() const { return rows_; }

 private:
  /// (stratum + inside) / strata, below 1 however it rounds.
  static double in_stratum(std::uint64_t stratum, double inside, std::uint64_t strata) {
    const double x = (static_cast<double>(stratum) + inside) / static_cast<double>(strata);
    return x < 1.0 ? x : 1.0 - 0x1p-53;
  }

  std::uint64_t rows_;
  std::uint64_t columns_;
  RandomStream stream_;
};

}  // namespace lightproof
