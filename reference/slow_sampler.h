// The obvious sampler in double: add up until the random number is passed. Too slow for use, too
// simple to be wrong.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

struct Texel {
  int x;
  int y;
  friend bool operator==(Texel, Texel) = default;
};

class SlowSampler {
 public:
  /// Throws InputError if the map is black.
  SlowSampler(const EnvironmentMap& map, TargetDensity target);

  /// The first row, then the first column in it, whose cumulative mass lies above u.
  Texel sample(SquarePoint u) const;

  /// Whether u lies within `distance` of a CDF entry of the row's or the column's distribution,
  /// where a correct sampler of finite precision may return the neighbour.
  bool near_entry(SquarePoint u, double distance) const;

 private:
  Grid<double> masses_;
  std::vector<double> rows_;
};

}  // namespace lightproof::reference
