#include "lightproof/image/map_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/stored_value.h"
#include "lightproof/warp/cube.h"

namespace lightproof {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();
/// Relative error beyond which a value counts as coarse.
constexpr double kCoarse = 0.01;

/// The formats in the order of the enumeration.
constexpr std::array kFormats = {
    MapFormatInfo{MapFormat::exr, "exr", "OpenEXR", "32-bit floats", kLargestFloat, true},
    MapFormatInfo{MapFormat::ktx2, "ktx2", "KTX 2.0", "16-bit floats", kLargestHalf, true},
    MapFormatInfo{MapFormat::hdr, "hdr", "Radiance .hdr",
                  "8-bit mantissas with one exponent for red, green and blue", kLargestRgbe, false},
    MapFormatInfo{MapFormat::png, "png", "PNG", "8 bits of c / (1 + c), sRGB-encoded",
                  kLargestFloat, false},
};

/// What a reader finds of a texel.
Rgb stored(MapFormat format, Rgb rgb) {
  if (format == MapFormat::hdr) return rgb_of(rgbe_of(rgb));
  if (format != MapFormat::ktx2) return rgb;
  const auto half = [](float v) { return float_of_half(half_bits(v)); };
  return {half(rgb.r), half(rgb.g), half(rgb.b)};
}

void count(LostValues& lost, double value, LevelTexel texel) {
  if (lost.count++ > 0 && !(std::abs(value) > std::abs(lost.worst))) return;
  lost.worst = value;
  lost.texel = texel;
}

void count_value(FormatLoss& loss, const MapFormatInfo& format, double value, double kept,
                 LevelTexel texel) {
  const double size = std::abs(value);
  if (!std::isfinite(value)) {
    count(loss.not_finite, value, texel);
  } else if (value < 0.0 && !format.holds_negative) {
    count(loss.negative, value, texel);
  } else if (size > format.largest) {
    count(loss.too_large, value, texel);
  } else if (value != 0.0 && kept == 0.0) {
    count(loss.vanished, value, texel);
  } else if (format.format == MapFormat::ktx2 && std::abs(kept - value) > kCoarse * size) {
    count(loss.coarse, value, texel);
  }
}

FormatLoss loss_in_row(const MapFormatInfo& format, const Grid<Rgb>& face, int number, int y) {
  FormatLoss loss;
  for (int x = 0; x < face.extent().width; ++x) {
    const Rgb value = face(x, y);
    const Rgb kept = stored(format.format, value);
    for (int i = 0; i < 3; ++i) {
      count_value(loss, format, static_cast<double>(value[i]), static_cast<double>(kept[i]),
                  {number, x, y});
    }
  }
  return loss;
}

void merge(LostValues& whole, LostValues part, int level) {
  if (part.count == 0) return;
  if (whole.count == 0 || std::abs(part.worst) > std::abs(whole.worst)) {
    whole = {whole.count, part.worst, level, part.texel};
  }
  whole.count += part.count;
}

void merge(FormatLoss& whole, const FormatLoss& part, int level) {
  for (LostValues FormatLoss::*kind :
       {&FormatLoss::not_finite, &FormatLoss::too_large, &FormatLoss::negative,
        &FormatLoss::vanished, &FormatLoss::coarse}) {
    merge(whole.*kind, part.*kind, level);
  }
}

/// "(level 0, face +X, column 3, row 5)".
std::string place_text(const LostValues& lost, const MapLevels& map) {
  const std::string face =
      is_cube(map.projection)
          ? fmt::format(", face {}", name_of(kCubeFaces[static_cast<std::size_t>(lost.texel.face)]))
          : "";
  return fmt::format("(level {}{}, column {}, row {})", lost.level, face, lost.texel.column,
                     lost.texel.row);
}

/// "1 value is", "12 values are".
std::string values_text(const LostValues& lost, std::string_view one, std::string_view more) {
  return fmt::format("{} {}", lost.count, lost.count == 1 ? one : more);
}

std::string refusal_text(const FormatLoss& loss, const MapFormatInfo& format,
                         const MapLevels& map) {
  std::string text;
  if (loss.not_finite.count > 0) {
    text += fmt::format("{} not finite, the first {}. ",
                        values_text(loss.not_finite, "value is", "values are"),
                        place_text(loss.not_finite, map));
  }
  if (loss.too_large.count > 0) {
    text += fmt::format("{} above {}, the largest that {} holds: up to {:.6g} {}. ",
                        values_text(loss.too_large, "value is", "values are"), format.largest,
                        format.title, loss.too_large.worst, place_text(loss.too_large, map));
  }
  if (loss.negative.count > 0) {
    text += fmt::format("{} negative, which {} cannot hold: down to {:.6g} {}. ",
                        values_text(loss.negative, "value is", "values are"), format.title,
                        loss.negative.worst, place_text(loss.negative, map));
  }
  return text;
}

std::string rounding_text(const FormatLoss& loss, const MapFormatInfo& format,
                          const MapLevels& map) {
  std::string text;
  if (loss.vanished.count > 0) {
    text += fmt::format(
        "{} 0, too small {}: up to {:.3g} {}. ",
        values_text(loss.vanished, "value becomes", "values become"),
        format.format == MapFormat::hdr ? "beside the texel's largest channel" : "for 16 bits",
        loss.vanished.worst, place_text(loss.vanished, map));
  }
  if (loss.coarse.count > 0) {
    text += fmt::format(
        "{} rounded by more than 1 %, too small for all digits of 16 bits: up to "
        "{:.3g} {}. ",
        values_text(loss.coarse, "value is", "values are"), loss.coarse.worst,
        place_text(loss.coarse, map));
  }
  return text;
}

std::string without_last_space(std::string text) {
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace

std::span<const MapFormatInfo> map_formats() { return kFormats; }

const MapFormatInfo& info(MapFormat format) { return kFormats[static_cast<std::size_t>(format)]; }

std::optional<MapFormat> map_format_by_name(std::string_view name) {
  const auto found = std::ranges::find(kFormats, name, &MapFormatInfo::name);
  if (found == kFormats.end()) return std::nullopt;
  return found->format;
}

bool FormatLoss::none() const { return !is_refused() && vanished.count == 0 && coarse.count == 0; }

bool FormatLoss::is_refused() const {
  return not_finite.count > 0 || too_large.count > 0 || negative.count > 0;
}

FormatLoss loss_in(MapFormat format, const MapLevels& map) {
  FormatLoss whole;
  for (int level = 0; level < static_cast<int>(map.levels.size()); ++level) {
    const std::vector<Grid<Rgb>>& faces = map.levels[static_cast<std::size_t>(level)].faces;
    for (int face = 0; face < static_cast<int>(faces.size()); ++face) {
      const Grid<Rgb>& texels = faces[static_cast<std::size_t>(face)];
      std::vector<FormatLoss> rows(static_cast<std::size_t>(texels.extent().height));
      parallel_for(rows.size(), [&](std::size_t y) {
        rows[y] = loss_in_row(info(format), texels, face, static_cast<int>(y));
      });
      for (const FormatLoss& row : rows) merge(whole, row, level);
    }
  }
  return whole;
}

std::string describe(const FormatLoss& loss, MapFormat format, const MapLevels& map) {
  return without_last_space(refusal_text(loss, info(format), map) +
                            rounding_text(loss, info(format), map));
}

void check_range(const std::string& file, MapFormat format, const MapLevels& map,
                 OutOfRange out_of_range) {
  FormatLoss loss = loss_in(format, map);
  if (out_of_range == OutOfRange::clamped) loss.too_large = loss.negative = {};
  if (!loss.is_refused()) return;
  const bool exr_holds_it = loss.not_finite.count == 0;
  throw InputError(fmt::format("{}: not written: {}{}", file, refusal_text(loss, info(format), map),
                               exr_holds_it ? "OpenEXR holds them." : "Finite values are needed."));
}

}  // namespace lightproof
