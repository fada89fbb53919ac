// The obvious sampler in double: add up until the random number is passed. Too slow for use, too
// simple to be wrong.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

/// Column and row of a texel.
struct Texel {
  int x;
  int y;
  friend bool operator==(Texel, Texel) = default;
};

/// A sampler of texels that adds up masses, in double, until the random number is passed.
class SlowSampler {
 public:
  /// Throws InputError if the map is black.
  SlowSampler(const EnvironmentMap& map, TargetDensity target);

  /// The first row whose cumulative mass lies above u.t, and the first column in it whose
  /// cumulative share of the row's mass lies above u.s.
  Texel sample(SquarePoint u) const;

  /// Whether u lies within `distance` of a CDF entry of the row's or the column's distribution,
  /// where a correct sampler of finite precision may return the neighbour.
  bool near_entry(SquarePoint u, double distance) const;

 private:
  Grid<double> masses_;
  std::vector<double> rows_;
};

}  // namespace lightproof::reference
