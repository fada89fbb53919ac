// What a picture file says of itself, whatever its format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/image/chromaticities.h"

namespace lightproof {

/// Largest picture that is read; beyond it a header is taken for damaged.
inline constexpr Extent kLargestPicture = {32768, 16384};

/// Which values of a file become radiance.
struct ChannelSelection {
  /// Three names for red, green and blue, or one that is read as grey. Empty: R, G and B.
  std::vector<std::string> channels = {};
  /// Stands before each name, with a point between them: "diffuse" for diffuse.R.
  std::string layer = {};
  /// Of an OpenEXR file, counted from 0. None: the first.
  std::optional<int> part = std::nullopt;

  /// The names in full, layer and all: three, or one.
  std::vector<std::string> names() const;
};

struct PictureHeader {
  std::string format;                 ///< "OpenEXR"
  Extent extent;                      ///< in pixels, as shown
  std::vector<std::string> parts;     ///< their names, one at least; empty where a part has none
  int part = 0;                       ///< the one that is read
  std::vector<std::string> channels;  ///< of that part
  std::vector<std::string> layers;    ///< of those channels: "diffuse" for diffuse.R
  std::vector<std::string> read;      ///< red, green and blue, or the one that is read as grey
  std::string orientation;            ///< "-Y 32 +X 64" or "3" (Exif); empty: rows from the top
  bool says_lat_long = false;         ///< the envmap attribute of an OpenEXR file
  std::optional<Chromaticities> chromaticities = {};
  double exposure = 1.0;  ///< that the values were multiplied by (EXPOSURE lines of Radiance)
  /// What was assumed or is left out, one sentence each.
  std::vector<std::string> notes = {};

  /// The channels that are not read.
  std::vector<std::string> left_out() const;
};

/// The layers of these channels, each once, in their order.
std::vector<std::string> layers_of(const std::vector<std::string>& channels);

/// "R, G, B, A"; a header may name thousands, so the list ends somewhere.
std::string listed(const std::vector<std::string>& names);

}  // namespace lightproof
