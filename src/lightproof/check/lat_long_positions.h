// Many directions at once on the square of latitude and longitude, to double precision.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/dump/sample_dump.h"

namespace lightproof {

/// Finds square_from_direction() of directions: an approximation by vectors, and from it one step
/// along parallel and meridian, whose error is the cube of the approximation's, 1e-21.
class LatLongPositions {
 public:
  explicit LatLongPositions(std::size_t most);

  /// Finds the positions of samples, `most` of them at the most. One whose direction is none has no
  /// numbers. Within 1e-3 of a pole s is no better than the approximation.
  void find(std::span<const DumpedSample> samples);

  double s(std::size_t i) const { return s_[i]; }
  double t(std::size_t i) const { return t_[i]; }
  /// sin(theta), the distance from the axis.
  double sine(std::size_t i) const { return from_axis_[i]; }

 private:
  std::vector<double> x_, y_, z_, s_, t_;
  std::vector<double> near_x_, near_y_, near_z_, near_sine_;  ///< at the approximate positions
  std::vector<double> from_axis_;
};

}  // namespace lightproof
