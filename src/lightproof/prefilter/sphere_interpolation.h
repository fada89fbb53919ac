// The value between the rows and columns of a latitude-longitude grid of a smooth function.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Interpolates a grid of values at texel centres by polynomials of degree 7 in s and in t, over 8
/// x 8 texels. Rows go on beyond a pole on the opposite meridian, where the function does, too: the
/// width must be even. The error for a wave of k radians from texel to texel is about k^8/1000.
glm::dvec3 interpolate_smooth(const Grid<Rgb>& samples, Direction direction);

}  // namespace lightproof
