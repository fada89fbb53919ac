// The primaries and the white of an RGB space, as headers of OpenEXR and Radiance files give them.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <string>
#include <string_view>
#include <tuple>

#include "lightproof/image/luminance.h"

namespace lightproof {

/// The primaries and the white of an RGB space, each as its CIE 1931 x and y.
struct Chromaticities {
  std::array<double, 2> red;
  std::array<double, 2> green;
  std::array<double, 2> blue;
  std::array<double, 2> white;
  static auto fields(auto& c) { return std::tie(c.red, c.green, c.blue, c.white); }
};

/// The name of the space of Rec. 709 and sRGB, which RGB means where a file says nothing; also the
/// first words of "Rec. 709 adapted to D50".
inline constexpr std::string_view kRec709Name = "Rec. 709";
/// The name of the space that RGB means in a Radiance file that says nothing.
inline constexpr std::string_view kRadianceName = "Radiance";

/// The name of an RGB space, "Rec. 2020", "ACEScg", …; empty if no space that has a name is within
/// 0.0015 in every coordinate.
std::string_view name_of(const Chromaticities& chromaticities);

/// Whether the primaries span a triangle and the white has a luminance.
bool is_colour_space(const Chromaticities& chromaticities);

/// The space of Rec. 709 and sRGB.
inline constexpr Chromaticities kRec709Space = {
    {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// The matrix from RGB of a space to CIE XYZ, for white (1, 1, 1) of luminance 1. Undefined unless
/// is_colour_space().
glm::dmat3 xyz_of_rgb(const Chromaticities& space);

/// The share of each channel in the luminance Y, for white (1, 1, 1) of luminance 1: the middle row
/// of the matrix from RGB to CIE XYZ. A weight is negative where a primary lies outside of the
/// visible colours. Undefined unless is_colour_space().
LuminanceWeights luminance_weights(const Chromaticities& chromaticities);

/// An RGB space in words: its name, or "R (0.68, 0.32), G (…), B (…), white (…)".
std::string describe(const Chromaticities& chromaticities);

/// Weights of a luminance in words: "0.2126, 0.7152, 0.0722".
std::string describe(LuminanceWeights weights);

}  // namespace lightproof
