// The primaries and the white of an RGB space, as headers of OpenEXR and Radiance files give them.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lightproof/image/luminance.h"

namespace lightproof {

/// CIE 1931 x and y of each.
struct Chromaticities {
  std::array<double, 2> red;
  std::array<double, 2> green;
  std::array<double, 2> blue;
  std::array<double, 2> white;
};

/// Of Rec. 709 and sRGB, what RGB means where a file says nothing; "… adapted to D50" is the same.
inline constexpr std::string_view kRec709Name = "Rec. 709";
/// What RGB means in Radiance where a file says nothing.
inline constexpr std::string_view kRadianceName = "Radiance";

/// "Rec. 2020", "ACEScg", …; empty if no space that has a name is within 0.0015 in every
/// coordinate.
std::string_view name_of(const Chromaticities& chromaticities);

/// Whether the primaries span a triangle and the white has a luminance.
bool is_colour_space(const Chromaticities& chromaticities);

/// The share of each channel in the luminance Y, for white (1, 1, 1) of luminance 1: the middle row
/// of the matrix from RGB to CIE XYZ. A weight is negative where a primary lies outside of the
/// visible colours. Undefined unless is_colour_space().
LuminanceWeights luminance_weights(const Chromaticities& chromaticities);

/// The name, or "R (0.68, 0.32), G (…), B (…), white (…)".
std::string describe(const Chromaticities& chromaticities);

/// "0.2126, 0.7152, 0.0722".
std::string describe(LuminanceWeights weights);

}  // namespace lightproof
