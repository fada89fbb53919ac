// Pictures for the page: tone mapping, size, and signed errors as colours.
#pragma once

#include <span>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// The factor that brings the geometric mean of the positive luminances to middle grey (0.18).
/// 1 for a black picture. Suits maps, whose arithmetic mean is ruled by the sun.
double grey_exposure(const Grid<Rgb>& picture);

/// The factor that brings the mean luminance of the lit pixels to 0.35; 1 for a black picture.
/// Suits renders: the unlit surroundings do not count.
double mean_exposure(const Grid<Rgb>& picture);

/// A picture for a screen: linear radiance times `scale`, clipped to [0,1] and sRGB-encoded.
/// Non-finite channels become 0 (NaN, -inf) or 1 (+inf).
Grid<Rgb> tone_mapped(const Grid<Rgb>& picture, double scale);

/// A picture that has the values in all three channels, as numbers rather than colours.
Grid<Rgb> grey_picture(const Grid<double>& values);

/// A smaller picture: averages whole blocks of pixels until the width is at most `max_width`; never
/// enlarges.
Grid<Rgb> shrunk(const Grid<Rgb>& picture, int max_width);

/// The six faces of a cube, +X, -X, +Y, -Y, +Z, -Z as in warp/cube.h, unfolded into a cross of 4 x
/// 3 faces: +Y over, -Y under +Z in the row -X, +Z, +X, -Z. What is left is `background`.
Grid<Rgb> unfolded_cube(std::span<const Grid<Rgb>> faces, Rgb background);

/// The sRGB colour of a signed value: blue at -range, white at 0, red at +range, clamped beyond; +v
/// and -v are equally far from white. Grey for a value that is not finite.
Rgb diverging_colour(double value, double range);

/// A picture of signed values, every pixel by diverging_colour().
Grid<Rgb> diverging_picture(const Grid<double>& values, double range);

/// A round number (1, 2 or 5 times a power of ten) that 99 % of the absolute values stay below;
/// 1 if all are zero. Non-finite values do not count.
double common_range(std::span<const Grid<double>* const> pictures);

}  // namespace lightproof
