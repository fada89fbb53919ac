// The probability integral transform of a target density: what a sound sampler draws becomes
// uniform and independent (Rosenblatt 1952).
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

/// Each share in [0,1], uniform if the density is right.
struct UnitPoint {
  double along;   ///< mass of all rows below
  double across;  ///< mass to the left in its own row, as a share of that row's
  double column;  ///< mass to the left over all rows
  /// Row of cells inside which the density has no edge: of texels, or of bilinear patches. -1 for a
  /// density that has no such rows.
  int row = -1;
  double share_of_row = 0.0;   ///< of the row's mass, below the point
  double share_of_cell = 0.0;  ///< of its cell's mass at the same t, to the left of the point
};

class UnitTransform {
 public:
  /// Of texel masses that sum to 1; uniform inside a texel in s, and in t or cos(theta) by the
  /// weighting.
  UnitTransform(const Grid<double>& masses, Weighting weighting);

  /// `at` lies in texel (x, y).
  UnitPoint operator()(SquarePoint at, int x, int y) const;

  /// The transformed coordinates of `at`, which lies in texel (x, y) and whose cos(theta) is known:
  /// `cosine` is cos_theta(at.t).
  UnitPoint operator()(SquarePoint at, double cosine, int x, int y) const;

 private:
  Extent extent_;
  Weighting weighting_;
  std::vector<double> rows_;     ///< knots
  std::vector<double> columns_;  ///< knots
  Grid<double> within_;          ///< knots of every row, W + 1
  std::vector<double> heights_;  ///< cos(theta) at the rows' edges
};

}  // namespace lightproof::reference
