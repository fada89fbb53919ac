// What a picture file says of itself, whatever its format.
#pragma once

#include <cstdint>
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
  /// The layer that stands before each name, with a point between them: "diffuse" for diffuse.R.
  std::string layer = {};
  /// The part of an OpenEXR file, counted from 0. None: the first.
  std::optional<int> part = std::nullopt;

  /// The full names of the channels, layer and all: three, or one.
  std::vector<std::string> names() const;
};

/// What is read all the same, though it is not a whole picture of red, green and blue.
struct Allowances {
  /// Pixels that the display window has and the data window has not are black.
  bool pad = false;
  /// Pixels that the data window has and the display window has not are left out.
  bool crop = false;
  /// Luminance and chroma, and CIE XYZ values, become linear RGB.
  bool to_rgb = false;
};

/// What is wrong with the size of a picture in pixels: empty unless both sides are at least 1 and
/// no larger than those of kLargestPicture, in either order.
std::string size_fault(std::int64_t width, std::int64_t height);

/// What a picture file says of itself, and what of it is read.
struct PictureHeader {
  std::string format;                 ///< "OpenEXR"
  Extent extent;                      ///< in pixels, as shown
  std::vector<std::string> parts;     ///< names of its parts, one at least; "" of one without
  int part = 0;                       ///< the part that is read, counted from 0
  std::vector<std::string> channels;  ///< channels of the part that is read
  std::vector<std::string> layers;    ///< layers of these channels: "diffuse" for diffuse.R
  std::vector<std::string> read;      ///< channels read as red, green and blue, or one as grey
  std::string orientation;            ///< "-Y 32 +X 64" or "3" (Exif); empty: rows from the top
  bool says_lat_long = false;         ///< the envmap attribute of an OpenEXR file
  std::optional<Chromaticities> chromaticities = {};
  double exposure = 1.0;  ///< what the values were multiplied by (EXPOSURE lines of Radiance)
  /// What was assumed or is left out, one sentence each.
  std::vector<std::string> notes = {};

  /// The channels of the part that are not read.
  std::vector<std::string> left_out() const;
};

/// The layers of these channels, each once, in their order.
std::vector<std::string> layers_of(const std::vector<std::string>& channels);

/// Names as a list in words, "R, G, B, A"; a header may name thousands, so the list ends somewhere.
std::string listed(const std::vector<std::string>& names);

}  // namespace lightproof
