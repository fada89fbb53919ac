// What a sampler makes of a regular grid of the unit square: whether it keeps neighbours together.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {

/// A grid of the unit square, drawn through one table of a map.
struct WarpGrid {
  std::string map;
  std::string sampler;       ///< "binary_search"
  bool is_monotone = false;  ///< whether the table is an inverse of cumulative sums
  int side = 0;              ///< points in each direction
  /// Where the centres of the grid's cells land on the map, row by row: side x side of them.
  std::vector<SquarePoint> points;
  double neighbour_degrees = 0.0;  ///< mean angle between the directions of neighbours in the grid
};

}  // namespace lightproof
