// A map in words and numbers, without its pixels: what `lightproof info` prints.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/run_description.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/image/reproject.h"

namespace lightproof {

/// What is known of a map and of the picture that it came from.
struct MapDescription {
  std::string name;
  std::string file;  ///< what the user called it: a path, or the name of a built-in map
  MapOrigin origin;
  Extent texels;  ///< extent of the map that the picture became
  Mapping mapping = {};
  LuminanceWeights weights = kRec709;
  MapFigures figures;
  PicturePixel peak;         ///< the brightest texel's column and row in the file
  Direction peak_direction;  ///< where its centre lies in the world, z up
  std::vector<std::string> notes;
};

/// The description of a map that was read or made.
MapDescription describe(const EnvironmentMap& map);

/// A description as one JSON object. Keys: name, file, format, width and height (in pixels of the
/// file), preset, preset_reason, mapping, parts, part, channels, layers, read, left_out,
/// orientation, primaries, exposure, luminance_weights, mean_luminance (over solid angle),
/// peak_luminance, peak_texel (column and row of the file), peak_direction, effective_fraction
/// (null if black), faults: [kind, count, column, row, message], refused (null, or why other
/// commands refuse the file), notes. Text that is not UTF-8 has its bad bytes replaced by U+FFFD.
std::string json_of(const MapDescription& description);

/// The objects that json_of() writes, each with format_version and, of `run`, version, commit and
/// command before its other keys: one object, or an array if there are several or `as_list`.
std::string info_json(const std::vector<MapDescription>& descriptions, const RunDescription& run,
                      bool as_list);

/// Version of the format of info_json() (docs/schema/info.schema.json).
inline constexpr int kInfoFormatVersion = 1;

/// A description as some lines for a terminal, the file's name first.
std::string text_of(const MapDescription& description);

}  // namespace lightproof
