// What a picture file stores, as lightproof-decode finds it: facts without judgement. Private to
// the image module and to the decoder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/enumeration.h"
#include "lightproof/image/chromaticities.h"

namespace lightproof {

/// A rectangle of pixels: the upper left one, and how many there are in a row and in a column.
struct PixelWindow {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t width = 0;
  std::int64_t height = 0;
  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
  static auto fields(auto& w) { return std::tie(w.x, w.y, w.width, w.height); }
};

enum class SampleType { uint8, uint16, uint32, half_float, single_float };
template <>
inline constexpr std::size_t kValuesOf<SampleType> = 5;

struct StoredChannel {
  std::string name;
  SampleType type = SampleType::single_float;
  bool is_subsampled = false;  ///< it has fewer samples than there are pixels
  static auto fields(auto& c) { return std::tie(c.name, c.type, c.is_subsampled); }
};

/// In which order lines of pixels are stored; without any of these, rows from the top, each from
/// the left.
struct StoredOrder {
  bool columns = false;  ///< lines are columns, from the left
  bool lines_backwards = false;
  bool pixels_backwards = false;
  friend bool operator==(const StoredOrder&, const StoredOrder&) = default;
  static auto fields(auto& o) { return std::tie(o.columns, o.lines_backwards, o.pixels_backwards); }
};

struct StoredPicture {
  std::vector<std::string> parts = {""};  ///< names of the file's parts; "" of one without
  PixelWindow data;                       ///< pixels that are stored, as shown
  PixelWindow display;                    ///< pixels of the whole picture, as shown
  std::int64_t tile_width = 0;            ///< 0 if lines are stored
  std::int64_t tile_height = 0;
  std::vector<StoredChannel> channels;
  std::string compression;  ///< of OpenEXR: "none", "zip", …
  bool is_deep = false;
  bool is_cube = false;      ///< the envmap attribute says so
  bool is_lat_long = false;  ///< the envmap attribute says so
  bool holds_xyz = false;    ///< the channels R, G and B are CIE X, Y and Z
  std::optional<Chromaticities> chromaticities;
  double gamma = 0.0;         ///< by which the values were encoded; 0 if the file says nothing
  double pixel_aspect = 1.0;  ///< width over height of a pixel
  std::string profile;        ///< name of a colour profile; empty if there is none
  int exif_orientation = 1;
  StoredOrder order;
  std::string order_text;          ///< as the file writes it; empty for the usual order
  double exposure = 1.0;           ///< what the values were multiplied by
  std::vector<std::string> notes;  ///< sentences on what was passed over

  static auto fields(auto& p) {
    return std::tie(p.parts, p.data, p.display, p.tile_width, p.tile_height, p.channels,
                    p.compression, p.is_deep, p.is_cube, p.is_lat_long, p.holds_xyz,
                    p.chromaticities, p.gamma, p.pixel_aspect, p.profile, p.exif_orientation,
                    p.order, p.order_text, p.exposure, p.notes);
  }
};

}  // namespace lightproof
