// The value of one level of a map at any direction, as a texture unit looks it up.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// Interpolates between the centres of the four nearest texels: s wraps around, t is clamped, so
/// that the half rows at the poles are constant in t.
inline glm::dvec3 look_up_bilinear(const Grid<Rgb>& level, SquarePoint at) {
  const auto [width, height] = level.extent();
  const double column = std::floor(at.s * width - 0.5);
  const double row = std::floor(at.t * height - 0.5);
  const double across = at.s * width - 0.5 - column;
  const double along = at.t * height - 0.5 - row;
  const int x0 = (static_cast<int>(column) + width) % width;
  const int x1 = (x0 + 1) % width;
  const int y0 = std::max(static_cast<int>(row), 0);
  const int y1 = std::min(static_cast<int>(row) + 1, height - 1);
  const auto between = [&](int y) {
    return (1.0 - across) * glm::dvec3(level(x0, y)) + across * glm::dvec3(level(x1, y));
  };
  return (1.0 - along) * between(y0) + along * between(y1);
}

/// The texel that holds the point; a coordinate of exactly 1 belongs to the last.
inline Rgb look_up_nearest(const Grid<Rgb>& level, SquarePoint at) {
  const auto [width, height] = level.extent();
  return level(std::clamp(static_cast<int>(at.s * width), 0, width - 1),
               std::clamp(static_cast<int>(at.t * height), 0, height - 1));
}

}  // namespace lightproof
