// The header of a Radiance picture: lines of text, an empty line, and the resolution, which says in
// which order the pixels follow. Source: Ward, "Real Pixels", Graphics Gems II (1991), and the file
// format's description in Radiance, ray/doc/filefmts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/decoder/byte_reader.h"
#include "lightproof/image/chromaticities.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {

/// The resolution line of a Radiance picture. "-Y 32 +X 64": 32 scanlines from the top down, each
/// of 64 pixels from left to right. X grows to the right and Y upwards; the first axis is that of
/// the scanlines, which are columns where it is X.
struct RadianceResolution {
  bool columns = false;              ///< scanlines are columns
  bool scanlines_backwards = false;  ///< +Y first, or -X first: from the bottom, or from the right
  bool pixels_backwards = false;     ///< within a scanline: from the right, or from the bottom
  int scanlines = 0;
  int pixels = 0;  ///< pixels of a scanline

  /// Width and height of the picture as it is shown, in pixels.
  Extent extent() const;
  /// The line itself: "-Y 32 +X 64".
  std::string text() const;
};

/// What the header of a Radiance picture says.
struct RadianceHeader {
  RadianceResolution resolution;
  bool says_format = false;
  bool holds_xyz = false;  ///< CIE X, Y and Z in the place of R, G and B
  double exposure = 1.0;   ///< product of all EXPOSURE lines
  std::array<double, 3> colour_correction = {1.0, 1.0, 1.0};  ///< product of all COLORCORR lines
  double pixel_aspect = 1.0;                                  ///< product of all PIXASPECT lines
  double gamma = 1.0;                                         ///< what the last GAMMA line says
  std::optional<Chromaticities> primaries;                    ///< what the last PRIMARIES line says
  bool has_view = false;
  std::vector<std::string> unreadable;  ///< lines of those names whose values are no numbers
};

/// Reads the header of a Radiance picture, up to the first byte of the pixels. Lines end with LF or
/// CR LF and may be of any length; indented ones are copies from the pictures that this one was
/// made of, and do not count. Throws InputError with the line or byte: a format other than
/// 32-bit_rle_rgbe or 32-bit_rle_xyze, no empty line, no resolution, a size beyond kLargestPicture.
RadianceHeader read_radiance_header(ByteReader& bytes);

/// What a reader of the picture should know of its header: one sentence each.
std::vector<std::string> notes_of(const RadianceHeader& header);

}  // namespace lightproof
