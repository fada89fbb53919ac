#include "lightproof/warp/preset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"
#include "lightproof/warp/octahedral.h"

namespace lightproof {
namespace {

/// The presets in the order of the enumeration.
constexpr std::array kPresets = {
    PresetInfo{Preset::z_up, "z-up",
               "z up: u = 1/2 - atan2(y,x)/2pi, v = acos(z)/pi from the top (Blender Cycles)",
               Lattice::texel_area, 2.0},
    PresetInfo{Preset::z_up_half_turn, "z-up-half-turn",
               "z up: u = 1 - frac(atan2(y,x)/2pi), v = acos(z)/pi from the top",
               Lattice::texel_area, 2.0},
    PresetInfo{Preset::openexr, "openexr",
               "y up: u = 1/2 - atan2(X,Z)/2pi, v = acos(Y)/pi from the top; pixels are nodes, so "
               "the first and last column coincide (OpenEXR's envmap attribute)",
               Lattice::node_centred, 2.0},
    PresetInfo{Preset::exr_area, "exr-area",
               "y up: u = 1/2 - atan2(X,Z)/2pi, v = acos(Y)/pi from the top; pixels are areas",
               Lattice::texel_area, 2.0},
    PresetInfo{Preset::pbrt_v3, "pbrt-v3",
               "z up: u = frac(atan2(y,x)/2pi), v = acos(z)/pi from the top", Lattice::texel_area,
               2.0},
    PresetInfo{Preset::pbrt_v4, "pbrt-v4",
               "z up: square equal-area octahedral map, first row at v = 0", Lattice::texel_area,
               1.0},
    PresetInfo{Preset::mitsuba, "mitsuba",
               "y up: u = frac(atan2(X,-Z)/2pi), v = acos(Y)/pi from the top", Lattice::texel_area,
               2.0},
    PresetInfo{Preset::cube, "cube",
               "six faces of a cube side by side or below each other: +X, -X, +Y, -Y, +Z, -Z as "
               "OpenGL and KTX hold them, Y up, each as seen from inside; -X is +x, +Y is +z",
               Lattice::texel_area, 6.0},
};

constexpr double kBelowOne = 0x1.fffffffffffffp-1;

/// s modulo 1, in [0, 1) for s in [-1, 2]; a tiny negative s, which rounds to 1, becomes 0.
double wrapped(double s) {
  const double fraction = s - std::floor(s);
  return fraction < 1.0 ? fraction : 0.0;
}

/// Turns the s of `z-up` into that of a lat-long preset and back: each of these is its own inverse.
/// With (X, Y, Z) = (y, z, x) the y-up presets are `z-up`: atan2(X, Z) is phi itself, and atan2(X,
/// -Z) is pi - phi.
double exchange_s(Preset preset, double s) {
  switch (preset) {
    case Preset::z_up_half_turn:
      return wrapped(0.5 + s);
    case Preset::pbrt_v3:
      return wrapped(0.5 - s);
    default:
      return s;
  }
}

SquarePoint below_one(SquarePoint at) {
  return {std::min(at.s, kBelowOne), std::min(at.t, kBelowOne)};
}

}  // namespace

std::span<const PresetInfo> presets() { return kPresets; }

const PresetInfo& info(Preset preset) { return kPresets[static_cast<std::size_t>(preset)]; }

std::optional<Preset> preset_by_name(std::string_view name) {
  const auto found = std::find_if(kPresets.begin(), kPresets.end(),
                                  [&](const PresetInfo& row) { return row.name == name; });
  if (found == kPresets.end()) return std::nullopt;
  return found->preset;
}

SquarePoint image_from_direction(Preset preset, Direction direction) {
  if (preset == Preset::pbrt_v4) {
    const SquarePoint at = square_from_octahedral(direction);
    return below_one({at.s, 1.0 - at.t});
  }
  if (preset == Preset::cube) {
    return below_one(square_point_of({MappingKind::cube_strip}, direction));
  }
  const SquarePoint at = square_from_direction(direction);
  const SquarePoint image = {exchange_s(preset, at.s), at.t};
  return info(preset).lattice == Lattice::node_centred ? image : below_one(image);
}

Direction direction_from_image(Preset preset, SquarePoint at) {
  if (preset == Preset::pbrt_v4) return octahedral_from_square({at.s, 1.0 - at.t});
  if (preset == Preset::cube) return direction_at({MappingKind::cube_strip}, at);
  return direction_from_square({exchange_s(preset, at.s), at.t});
}

}  // namespace lightproof
