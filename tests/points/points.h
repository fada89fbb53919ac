// Points of the registry's sets, for the tests.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lightproof/points/registry.h"

namespace lightproof::test {

/// The points first … first + count - 1 of a set of `size` points.
inline std::vector<SquarePoint> window_of(std::string_view set, std::uint64_t size,
                                          std::uint64_t first, std::uint64_t count,
                                          PointSeed seed = {}) {
  std::vector<SquarePoint> points(static_cast<std::size_t>(count));
  fill_points(point_set_by_name(set).prepare(size, seed), first, points);
  return points;
}

/// All points of a set of this many.
inline std::vector<SquarePoint> all_of(std::string_view set, std::uint64_t count,
                                       PointSeed seed = {}) {
  return window_of(set, count, 0, count, seed);
}

}  // namespace lightproof::test
