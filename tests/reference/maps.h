// Small maps for the tests of the reference.
#pragma once

#include <string>
#include <vector>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A map of these luminances, row t = 0 first.
inline EnvironmentMap grey_map(Extent extent, const std::vector<float>& values) {
  EnvironmentMap map{"grey", Grid<Rgb>(extent), {}};
  for (std::size_t i = 0; i < values.size(); ++i) map.radiance.values()[i] = Rgb(values[i]);
  return map;
}

/// Shapes that try a program: one texel, one row, one column, odd numbers.
inline constexpr Extent kExtents[] = {{1, 1}, {2, 1}, {1, 2}, {3, 5}, {7, 5}, {33, 17}, {64, 32}};

}  // namespace lightproof
