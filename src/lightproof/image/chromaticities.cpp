#include "lightproof/image/chromaticities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace lightproof {
namespace {

struct NamedSpace {
  std::string_view name;
  Chromaticities chromaticities;
};

constexpr NamedSpace kSpaces[] = {
    {kRec709Name, kRec709Space},
    // As ICC profiles describe it, in their own white: programs that go by profiles write this to
    // OpenEXR files of plain Rec. 709 values.
    {"Rec. 709 adapted to D50",
     {{0.6484, 0.3309}, {0.3212, 0.5979}, {0.1559, 0.0660}, {0.3457, 0.3585}}},
    {kRadianceName, {{0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}, {0.3333, 0.3333}}},
    {"Rec. 2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}},
    {"ACEScg", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}},
    {"ACES 2065-1 (AP0)", {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, {0.32168, 0.33767}}},
    {"Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}},
    {"DCI-P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
    {"Adobe RGB (1998)", {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}}},
};

/// Headers round to three digits or hold floats of more.
constexpr double kTolerance = 0.0015;
/// Twice the area of a triangle that is taken for none; that of Rec. 709 is 0.22.
constexpr double kLeastArea = 1e-6;

bool are_near(std::array<double, 2> a, std::array<double, 2> b) {
  return std::abs(a[0] - b[0]) <= kTolerance && std::abs(a[1] - b[1]) <= kTolerance;
}

bool are_near(const Chromaticities& a, const Chromaticities& b) {
  return are_near(a.red, b.red) && are_near(a.green, b.green) && are_near(a.blue, b.blue) &&
         are_near(a.white, b.white);
}

/// (x, y, 1 - x - y): XYZ up to its scale, whose middle value is y.
glm::dvec3 ray_of(std::array<double, 2> xy) { return {xy[0], xy[1], 1.0 - xy[0] - xy[1]}; }

glm::dmat3 primaries_of(const Chromaticities& space) {
  return {ray_of(space.red), ray_of(space.green), ray_of(space.blue)};
}

std::string describe(std::array<double, 2> xy) {
  return fmt::format("({:.4g}, {:.4g})", xy[0], xy[1]);
}

}  // namespace

std::string_view name_of(const Chromaticities& chromaticities) {
  const auto found = std::ranges::find_if(kSpaces, [&](const NamedSpace& space) {
    return are_near(space.chromaticities, chromaticities);
  });
  return found == std::end(kSpaces) ? std::string_view() : found->name;
}

bool is_colour_space(const Chromaticities& space) {
  const double area = glm::determinant(primaries_of(space));
  return std::isfinite(area) && std::abs(area) > kLeastArea && std::isfinite(space.white[0]) &&
         space.white[1] > kLeastArea;
}

glm::dmat3 xyz_of_rgb(const Chromaticities& space) {
  const glm::dvec3 white = ray_of(space.white) / space.white[1];
  glm::dmat3 matrix = primaries_of(space);
  const glm::dvec3 scales = glm::inverse(matrix) * white;
  for (int i = 0; i < 3; ++i) matrix[i] *= scales[i];
  return matrix;
}

LuminanceWeights luminance_weights(const Chromaticities& space) {
  const glm::dmat3 matrix = xyz_of_rgb(space);
  return {matrix[0].y, matrix[1].y, matrix[2].y};
}

std::string describe(const Chromaticities& space) {
  const std::string_view name = name_of(space);
  if (!name.empty()) return std::string(name);
  return fmt::format("R {}, G {}, B {}, white {}", describe(space.red), describe(space.green),
                     describe(space.blue), describe(space.white));
}

std::string describe(LuminanceWeights weights) {
  return fmt::format("{:.4f}, {:.4f}, {:.4f}", weights.red, weights.green, weights.blue);
}

}  // namespace lightproof
