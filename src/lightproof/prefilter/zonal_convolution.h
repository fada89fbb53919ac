// Convolution of a map with lobes that depend on the angle to their axis alone, by spherical
// harmonics: the map is expanded once, up to the degree where all lobes have faded; for each lobe
// the coefficients are multiplied by its zonal factors and summed at the texel centres of a grid.
//
// The map is constant in each texel, and expanded without error: what a truncated series leaves out
// is the only approximation. Of lobes that are smooth, their factors fall off exponentially, and
// that can be made as small as one likes.
//
// Alternatives: a Fourier series in longitude for every pair of an input and an output row, which
// needs as many operations for the one lobe as this for the whole chain; sums over texels near the
// axis and block means beyond, which lose more to the means than this to the series.
//
// The work for degree l_max, a map of H rows and outputs of h rows in all is about
// 7 l_max^2 (H + h)/4 multiply-adds, and a Fourier transform of each row.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// The most degrees that the transform can take: beyond it, functions of middling order underflow
/// near the poles before they have grown.
inline constexpr int kLargestDegree = 1800;

/// What the harmonics of degree l = 0, 1, … are multiplied by, and the grid at whose texel centres
/// the result is taken. At most kLargestDegree + 1 factors.
struct ZonalFilter {
  std::vector<double> factors;
  Extent extent;
};

/// One grid for each filter. The map may have any size, and so may the grids. Where a series was
/// cut off, values may be slightly negative.
std::vector<Grid<Rgb>> convolve(const Grid<Rgb>& map, std::span<const ZonalFilter> filters);

}  // namespace lightproof
