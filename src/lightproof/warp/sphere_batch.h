// Many directions of the sphere at once, with vectors: drawn uniformly, and found on the map.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof {

/// Where uniform_directions writes: unit vectors, and the position of each on the map. All of one
/// size.
struct DirectionSpans {
  std::span<double> x;
  std::span<double> y;
  std::span<double> z;
  std::span<double> t;
};

/// Draws directions of the density 1/4pi at uniform numbers: s[i] chooses the azimuth, and is the
/// position on the map, u[i] chooses z = 2 u[i] - 1 (Archimedes: equal heights, equal areas). They
/// are direction_from_square({s[i], t[i]}), to some roundings. All spans are of one size. Returns
/// how many directions vectors drew, from the front: 0 on a processor without vectors.
std::size_t uniform_directions(std::span<const double> s, std::span<const double> u,
                               const DirectionSpans& directions);

/// Where directions_of_positions writes: unit vectors, and the sine of each one's angle to the
/// nearer pole. All of one size.
struct PositionedDirectionSpans {
  std::span<double> x;
  std::span<double> y;
  std::span<double> z;
  std::span<double> sine;
};

/// Writes direction_from_square({s[i], t[i]}) and sin_theta(t[i]), to some roundings, of positions
/// in [0,1]^2. All spans are of one size. Returns how many of them vectors wrote, from the front: 0
/// on a processor without vectors.
std::size_t directions_of_positions(std::span<const double> s, std::span<const double> t,
                                    const PositionedDirectionSpans& directions);

/// Where approximate_positions writes: points of the square, as two arrays of one size.
struct PositionSpans {
  std::span<double> s;
  std::span<double> t;
};

/// Writes approximate_square_from_direction() of every (x[i], y[i], z[i]): off by up to 2e-8, which
/// is 2e-4 of a texel's width on a map of 8192. All spans are of one size.
void approximate_positions(std::span<const double> x, std::span<const double> y,
                           std::span<const double> z, const PositionSpans& positions);

}  // namespace lightproof
