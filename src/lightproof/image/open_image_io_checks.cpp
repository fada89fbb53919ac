#include "lightproof/image/open_image_io_checks.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "lightproof/image/file_format.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kLargestTile = std::int64_t{4096} * 4096;
/// What a chunk of an OpenEXR file takes beside its pixels: its place in the table of chunks, the
/// row and the size.
constexpr std::uint64_t kBytesOfChunk = 8 + 4 + 4;
/// DEFLATE (zlib) writes at least 2 bits for 258 bytes.
constexpr std::uint64_t kLargestDeflation = 1032;
/// Bits of a pixel with a palette, and of the same pixel as red, green, blue and alpha: 1 to 32.
constexpr std::uint64_t kLargestPalette = 32;

void check_tiles(const fs::path& file, const OIIO::ImageSpec& spec) {
  const std::int64_t tile = std::int64_t{spec.tile_width} * spec.tile_height;
  if (tile < 0 || tile > std::max(kLargestTile, 4 * std::int64_t{spec.width} * spec.height)) {
    refuse(file, fmt::format("the header says tiles of {} x {} pixels for a picture of {} x {}",
                             spec.tile_width, spec.tile_height, spec.width, spec.height));
  }
}

void check_windows(const fs::path& file, const OIIO::ImageSpec& spec) {
  if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
      spec.height == spec.full_height) {
    return;
  }
  refuse(file, fmt::format("the data window ({} x {} at {}, {}) differs from the display window "
                           "({} x {} at {}, {}): crop or pad the picture to the whole panorama",
                           spec.width, spec.height, spec.x, spec.y, spec.full_width,
                           spec.full_height, spec.full_x, spec.full_y));
}

/// Exif can also store columns as rows; readers differ in what they make of it.
void check_orientation(const fs::path& file, const OIIO::ImageSpec& spec) {
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation >= 0 && orientation <= 4) return;
  refuse(file, fmt::format("the header says orientation {}, a quarter turn or columns stored as "
                           "rows: store it row by row first",
                           orientation));
}

/// Red, green, blue and white, x and y of each.
std::optional<std::array<float, 8>> chromaticity_values(const OIIO::ImageSpec& spec) {
  std::array<float, 8> xy{};
  if (!spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy.data())) {
    return std::nullopt;
  }
  return xy;
}

/// A file of CIE XYZ values declares (1, 0) and (0, 1) as the chromaticities of its "R" and "G".
bool holds_xyz(const OIIO::ImageSpec& spec) {
  const auto xy = chromaticity_values(spec);
  return xy && (*xy)[0] == 1.0F && (*xy)[1] == 0.0F && (*xy)[2] == 0.0F && (*xy)[3] == 1.0F;
}

/// Rows that are compressed together.
int rows_of_chunk(std::string_view compression) {
  if (compression.starts_with("dwab")) return 256;
  for (const std::string_view name : {"piz", "b44", "dwaa"}) {
    if (compression.starts_with(name)) return 32;
  }
  if (compression.starts_with("zips")) return 1;
  return compression.starts_with("zip") || compression.starts_with("pxr24") ? 16 : 1;
}

std::uint64_t chunks_of(int pixels, int chunk) {
  return (static_cast<std::uint64_t>(pixels) + static_cast<std::uint64_t>(chunk) - 1) /
         static_cast<std::uint64_t>(chunk);
}

std::uint64_t least_bytes_of_exr(const OIIO::ImageSpec& spec) {
  const std::string compression = spec.get_string_attribute("compression", "none");
  const std::uint64_t chunks =
      spec.tile_width > 0
          ? chunks_of(spec.width, spec.tile_width) * chunks_of(spec.height, spec.tile_height)
          : chunks_of(spec.height, rows_of_chunk(compression));
  const std::uint64_t pixels = spec.image_bytes(true);
  std::uint64_t ratio = 0;  // not known
  if (compression == "none") ratio = 1;
  if (compression.starts_with("zip")) ratio = kLargestDeflation;
  return kBytesOfChunk * chunks + (ratio == 0 ? 0 : pixels / ratio);
}

}  // namespace

void check_header(const fs::path& file, const OIIO::ImageSpec& spec) {
  if (spec.depth > 1) refuse(file, "holds a volume: a flat picture needed");
  check_size(file, spec.width, spec.height);
  check_tiles(file, spec);
  if (spec.deep) refuse(file, "holds deep samples: a flat picture needed");
  if (spec.get_string_attribute("textureformat") == "CubeFace Environment") {
    refuse(file, "the envmap attribute says cube map: convert it to latitude-longitude first");
  }
  if (holds_xyz(spec)) refuse(file, "holds CIE XYZ values: convert it to linear RGB first");
  check_windows(file, spec);
  check_orientation(file, spec);
}

void check_file_length(const fs::path& file, const OIIO::ImageSpec& spec) {
  const std::string what = fmt::format("{} x {} pixels", spec.width, spec.height);
  const bool is_integer = !spec.format.is_floating_point();
  const std::uint64_t least = is_integer
                                  ? spec.image_bytes() / (kLargestPalette * kLargestDeflation)
                                  : least_bytes_of_exr(spec);
  check_length(file, fs::file_size(file), least, what);
}

std::vector<int> channel_indices(const fs::path& file, const OIIO::ImageSpec& spec,
                                 const std::vector<std::string>& names) {
  std::vector<int> indices;
  for (const std::string& name : names) {
    const int channel = spec.channelindex(name);
    const OIIO::TypeDesc type = spec.channelformat(channel);
    const bool is_picture = type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16;
    if (!is_picture && !type.is_floating_point()) {
      refuse(file,
             fmt::format("channel {} holds {} values: half or float needed", name, type.c_str()));
    }
    indices.push_back(channel);
  }
  return indices;
}

std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec) {
  const auto values = chromaticity_values(spec);
  if (!values) return std::nullopt;
  std::array<double, 8> xy{};
  std::ranges::copy(*values, xy.begin());
  const Chromaticities found = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
  return is_colour_space(found) ? std::optional(found) : std::nullopt;
}

}  // namespace lightproof
