// The conventions by which renderers map directions to the pixels of an environment map.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// A convention by which directions map to the pixels of an environment map.
enum class Preset {
  z_up,
  z_up_half_turn,
  openexr,
  exr_area,
  pbrt_v3,
  pbrt_v4,
  mitsuba,
  cube,
};

/// How pixels sit on the image square.
enum class Lattice {
  texel_area,    ///< pixel (i, r) covers [i/W, (i+1)/W) x [r/H, (r+1)/H)
  node_centred,  ///< pixel (i, r) is the value at (i/(W-1), r/(H-1))
};

/// What is known of a preset.
struct PresetInfo {
  Preset preset;
  std::string_view name;         ///< name on the command line: `z-up-half-turn`
  std::string_view description;  ///< axes and formula, one line
  Lattice lattice;
  /// Width / height that the convention asks for: 2, 1 for octahedral pictures, 6 for the faces of
  /// a cube, which may stand below each other as well.
  double aspect;
};

/// All presets, in the order of their enumeration.
std::span<const PresetInfo> presets();
/// What is known of a preset.
const PresetInfo& info(Preset preset);
/// The preset of this name; none if there is none.
std::optional<Preset> preset_by_name(std::string_view name);

/// Image coordinates: s from the left, t from the *bottom* of the image, in [0,1)^2 for
/// texel_area and [0,1]^2 for node_centred, of the direction in Lightproof's world (z up).
/// Presets with y up use (X, Y, Z) = (y, z, x).
SquarePoint image_from_direction(Preset preset, Direction direction);

/// The direction, a unit vector in Lightproof's world (z up), of image coordinates; the inverse of
/// image_from_direction.
Direction direction_from_image(Preset preset, SquarePoint at);

}  // namespace lightproof
