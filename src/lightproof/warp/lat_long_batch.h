// Many points of the map as directions at once, with vectors.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof {

/// Where directions_from_squares writes: of each point the unit vector, and d(omega) / (ds dt) in
/// steradian per unit square. All of one size.
struct DirectionSpans {
  std::span<double> x;
  std::span<double> y;
  std::span<double> z;
  std::span<double> steradian;
};

/// direction_from_square and solid_angle_per_square of every (s[i], t[i]), to some roundings of a
/// sine. All spans are of one size.
void directions_from_squares(std::span<const double> s, std::span<const double> t,
                             const DirectionSpans& directions);

}  // namespace lightproof
