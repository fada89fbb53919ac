// The probability integral transform of a target density: what a correct sampler draws becomes
// uniform and independent (Rosenblatt 1952).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

/// Coordinates of the Rosenblatt transform and what they are made of, each a share in [0,1],
/// uniform if the density is right.
struct RosenblattPoint {
  double marginal;         ///< mass below the point's t
  double conditional;      ///< mass to the left of the point at its t, as a share of all mass there
  double column_marginal;  ///< mass to the left of the point's s, over all rows
  /// Row of cells inside which the density has no edge: of texels, or of bilinear patches. -1 for a
  /// density that has no such rows.
  int row = -1;
  double share_of_row = 0.0;   ///< share of the row's mass that lies below the point
  double share_of_cell = 0.0;  ///< share of the mass in its cell at its t that lies to its left
};

/// The Rosenblatt transform of a density that is given by the masses of texels. It keeps the sums
/// of a row up to every eighth texel alone, and adds the masses from there on: an eighth of the
/// memory of all sums, and their bits.
class RosenblattTransform {
 public:
  /// The transform of a density given by texel masses that sum to 1; uniform inside a texel in s,
  /// and in t or cos(theta) by position_measure() of the density.
  RosenblattTransform(SharedGrid<double> masses, DensitySpace density_space)
      : RosenblattTransform(std::move(masses), position_measure(density_space)) {}
  /// The transform of a distribution with these masses of texels, uniform inside a texel in this
  /// measure; in solid angle only in rows of latitude and longitude. Coordinates are those of the
  /// square of any mapping.
  RosenblattTransform(SharedGrid<double> masses, MapMeasure positions);

  /// The transformed coordinates of `at`, which lies in texel (x, y).
  RosenblattPoint operator()(SquarePoint at, int x, int y) const;

  /// The transformed coordinates of `at`, which lies in texel (x, y) and whose cos(theta) is known:
  /// `cosine` is cos_theta(at.t).
  RosenblattPoint operator()(SquarePoint at, double cosine, int x, int y) const;

 private:
  /// Texels of a row from one sum that is kept to the next: one line of the cache.
  static constexpr int kStep = 8;

  /// The CDF entries of row y on both sides of texel x.
  std::array<double, 2> entries_around(int x, int y) const;

  SharedGrid<double> masses_;
  MapMeasure measure_;              ///< in which positions are uniform
  std::vector<double> rows_;        ///< CDF entries
  std::vector<double> columns_;     ///< CDF entries
  Grid<double> sums_;               ///< of the masses of a row before every kStep-th texel
  std::vector<double> row_masses_;  ///< of the rows, summed from left to right
  std::vector<double> heights_;     ///< cos(theta) at the rows' edges
};

}  // namespace lightproof::reference
