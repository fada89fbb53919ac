// How far a prefiltered level is off.
#pragma once

#include <glm/glm.hpp>

#include "lightproof/core/grid.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::bench {

/// Mean square of the difference between a level and the exact one of its size, relative to that of
/// the exact values, over solid angle and the three channels.
inline double relative_mean_square(const Grid<Rgb>& level, const Grid<glm::dvec3>& exact) {
  const auto square = [](glm::dvec3 value) { return glm::dot(value, value); };
  double difference = 0.0;
  double whole = 0.0;
  for (int y = 0; y < exact.extent().height; ++y) {
    const double area = texel_solid_angle(exact.extent(), y);
    for (int x = 0; x < exact.extent().width; ++x) {
      difference += area * square(glm::dvec3(level(x, y)) - exact(x, y));
      whole += area * square(exact(x, y));
    }
  }
  return difference / whole;
}

}  // namespace lightproof::bench
