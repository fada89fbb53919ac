// Where a map comes from: the picture, how it was read, what was wrong with it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/image/picture_header.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

/// Something for which a file is refused unless an option allows it.
struct MapFault {
  std::string kind;       ///< "NaN", "infinite values", "negative values", "aspect", "black"
  std::string message;    ///< what the refusal says of it
  std::size_t count = 0;  ///< how many texels; 0 where the picture as a whole is at fault
  /// Column of the first such texel, counted from 0 at the left of the picture.
  int column = 0;
  /// Row of the first such texel, counted from 0 at the top of the picture.
  int row = 0;
};

/// Where a map comes from; the initial values are those of a built-in map, whose rows and columns
/// follow `z-up`.
struct MapOrigin {
  PictureHeader picture = {.format = "built-in",
                           .extent = {},
                           .parts = {""},
                           .channels = {"R", "G", "B"},
                           .layers = {},
                           .read = {"R", "G", "B"},
                           .orientation = {}};
  Preset preset = Preset::z_up;
  std::string why_preset = "built-in maps follow it";
  /// Whether the map has texels of latitude and longitude whatever the picture had.
  bool is_resampled = false;
  /// What was found wrong with the file, repaired or not.
  std::vector<MapFault> faults = {};
  /// The message with which read_environment_map() refuses the file; empty if it does not.
  std::string refusal = {};
};

}  // namespace lightproof
