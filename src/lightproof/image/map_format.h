// The formats in which maps are written, and what each of them cannot hold.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lightproof/image/map_levels.h"

namespace lightproof {

enum class MapFormat {
  exr,   ///< OpenEXR, 32-bit floats
  ktx2,  ///< KTX 2.0, 16-bit floats
  hdr,   ///< Radiance, three 8-bit mantissas with one exponent
  png,   ///< 8 bits of c / (1 + c), sRGB-encoded: for looking at
};

struct MapFormatInfo {
  MapFormat format;
  std::string_view name;       ///< as on the command line, and the extension: `ktx2`
  std::string_view title;      ///< "KTX 2.0"
  std::string_view precision;  ///< of a value, in words
  double largest;              ///< that it can hold
  bool holds_negative;
};

std::span<const MapFormatInfo> map_formats();
const MapFormatInfo& info(MapFormat format);
/// None if there is no format of this name.
std::optional<MapFormat> map_format_by_name(std::string_view name);

/// Values (of one channel of one texel) of one kind, and the largest of them without its sign.
struct LostValues {
  std::size_t count = 0;
  double worst = 0.0;
  int level = 0;
  LevelTexel texel = {};  ///< of the worst; the first of equals
};

/// What becomes of a map's values in a format, beside the rounding that the format is known for.
struct FormatLoss {
  LostValues not_finite;  ///< NaN and infinities, which no map may have
  LostValues too_large;   ///< above the format's largest
  LostValues negative;    ///< where the format has no sign
  LostValues vanished;  ///< not 0, and stored as 0: too small, or too small beside another channel
  LostValues coarse;    ///< stored with a relative error above 1 %, since too small for 16 bits

  /// Every value is held.
  bool none() const;
  /// Some are beyond what the format can hold: it needs another one, or clamping.
  bool is_refused() const;
};

FormatLoss loss_in(MapFormat format, const MapLevels& map);

/// One sentence a kind of loss, "12 values are above 65504, the largest that 16-bit floats hold: up
/// to 100000, in level 0 at face +X, column 3, row 5."; empty if there is none.
std::string describe(const FormatLoss& loss, MapFormat format, const MapLevels& map);

/// What becomes of values that a format cannot hold.
enum class OutOfRange {
  refused,  ///< nothing is written
  clamped,  ///< too large ones become the largest, negative ones 0; others are refused
};

/// Throws InputError that begins with `file` if the loss forbids that the map is written.
void check_range(const std::string& file, MapFormat format, const MapLevels& map,
                 OutOfRange out_of_range);

}  // namespace lightproof
