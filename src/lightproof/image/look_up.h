// The value of a map at any position: what a renderer's texture look-up returns.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// The map's value at a point of [0,1]^2, interpolated between the centres of texels: s wraps
/// around, t is clamped, so that the half rows at the poles are constant in t. `Texels` is a Grid,
/// or whatever else has an extent and a value for each texel.
template <class Texels>
double look_up_bilinear(const Texels& luminance, SquarePoint at) {
  const auto [width, height] = luminance.extent();
  const double column = std::floor(at.s * width - 0.5);
  const double row = std::floor(at.t * height - 0.5);
  const double across = at.s * width - 0.5 - column;
  const double along = at.t * height - 0.5 - row;
  const int x0 = (static_cast<int>(column) + width) % width;
  const int x1 = (x0 + 1) % width;
  const int y0 = std::max(static_cast<int>(row), 0);
  const int y1 = std::min(static_cast<int>(row) + 1, height - 1);
  return (1.0 - along) * ((1.0 - across) * luminance(x0, y0) + across * luminance(x1, y0)) +
         along * ((1.0 - across) * luminance(x0, y1) + across * luminance(x1, y1));
}

/// The value of the texel that `at` lies in; a coordinate of exactly 1 belongs to the last.
template <class Texels>
auto look_up_nearest(const Texels& values, SquarePoint at) {
  const auto [width, height] = values.extent();
  return values(std::clamp(static_cast<int>(at.s * width), 0, width - 1),
                std::clamp(static_cast<int>(at.t * height), 0, height - 1));
}

/// The map's value at a point of [0,1]^2 by either look-up.
template <class Texels>
double look_up(const Texels& luminance, Lookup lookup, SquarePoint at) {
  return lookup == Lookup::nearest ? look_up_nearest(luminance, at)
                                   : look_up_bilinear(luminance, at);
}

}  // namespace lightproof
