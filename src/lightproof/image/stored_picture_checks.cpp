#include "lightproof/image/stored_picture_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/image/file_format.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

/// Windows are numbers of 32 bits, and their sizes of 33.
constexpr std::int64_t kLargestNumber = std::int64_t{1} << 33U;
constexpr std::int64_t kLargestTileSide = std::int64_t{1} << 31U;
constexpr std::int64_t kLargestTile = std::int64_t{4096} * 4096;
/// What a chunk of an OpenEXR file takes beside its pixels: its place in the table of chunks, the
/// row and the size.
constexpr std::uint64_t kBytesOfChunk = 8 + 4 + 4;
/// DEFLATE (zlib) writes at least 2 bits for 258 bytes.
constexpr std::uint64_t kLargestDeflation = 1032;
/// Bits of a pixel with a palette, and of the same pixel as red, green, blue and alpha: 1 to 32.
constexpr std::uint64_t kLargestPalette = 32;
/// Pixels of a picture for one that is stored.
constexpr std::int64_t kMostPadding = 1024;
constexpr double kDecodeExponent = 2.2;

void check_size(const fs::path& file, const PixelWindow& window) {
  if (const std::string fault = size_fault(window.width, window.height); !fault.empty()) {
    refuse(file, fault);
  }
}

void check_tiles(const fs::path& file, const StoredPicture& stored) {
  const std::int64_t tile = stored.tile_width * stored.tile_height;
  if (tile > std::max(kLargestTile, 4 * stored.data.width * stored.data.height)) {
    refuse(file, fmt::format("the header says tiles of {} x {} pixels for a picture of {} x {}",
                             stored.tile_width, stored.tile_height, stored.data.width,
                             stored.data.height));
  }
}

bool has_all_of(const PixelWindow& outer, const PixelWindow& inner) {
  return outer.x <= inner.x && outer.y <= inner.y &&
         outer.x + outer.width >= inner.x + inner.width &&
         outer.y + outer.height >= inner.y + inner.height;
}

bool overlap(const PixelWindow& a, const PixelWindow& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void check_windows(const fs::path& file, const StoredPicture& stored, const Allowances& allow) {
  const PixelWindow& data = stored.data;
  const PixelWindow& display = stored.display;
  const bool needs_padding = !allow.pad && !has_all_of(data, display);
  const bool needs_cropping = !allow.crop && !has_all_of(display, data);
  if (!needs_padding && !needs_cropping && overlap(data, display)) {
    check_size(file, display);
    const std::int64_t most = kMostPadding * data.width * data.height;
    if (display.width * display.height <= most) return;
    refuse(file,
           fmt::format("the display window has {} x {} pixels, of which the file stores {} x {}: "
                       "so few say that its header is damaged",
                       display.width, display.height, data.width, data.height));
  }
  std::string help = "no pixel lies in both";
  if (overlap(data, display)) {
    help = needs_padding ? "--pad reads the missing pixels as black" : "";
    if (needs_padding && needs_cropping) help += ", and ";
    if (needs_cropping) help += "--crop leaves out those beyond the display window";
  }
  refuse(file, fmt::format("the data window ({} x {} at {}, {}) differs from the display window "
                           "({} x {} at {}, {}): {}",
                           data.width, data.height, data.x, data.y, display.width, display.height,
                           display.x, display.y, help));
}

/// Exif can also store columns as rows; readers differ in what they make of it.
void check_orientation(const fs::path& file, const StoredPicture& stored) {
  const int orientation = stored.exif_orientation;
  if (orientation >= 0 && orientation <= 4) return;
  refuse(file, fmt::format("the header says orientation {}, a quarter turn or columns stored as "
                           "rows: store it row by row first",
                           orientation));
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

std::uint64_t chunks_of(std::int64_t pixels, std::int64_t chunk) {
  return static_cast<std::uint64_t>((pixels + chunk - 1) / chunk);
}

std::uint64_t bytes_of(SampleType type) {
  switch (type) {
    case SampleType::uint8:
      return 1;
    case SampleType::uint16:
    case SampleType::half_float:
      return 2;
    case SampleType::uint32:
    case SampleType::single_float:
      break;
  }
  return 4;
}

/// Bytes of all samples of the channels that have one at every pixel.
std::uint64_t bytes_of_samples(const StoredPicture& stored) {
  std::uint64_t bytes = 0;
  for (const StoredChannel& channel : stored.channels) {
    if (!channel.is_subsampled) bytes += bytes_of(channel.type);
  }
  return bytes * static_cast<std::uint64_t>(stored.data.width * stored.data.height);
}

std::uint64_t least_bytes_of_exr(const StoredPicture& stored) {
  const std::string& compression = stored.compression;
  const PixelWindow& data = stored.data;
  const std::uint64_t chunks =
      stored.tile_width > 0
          ? chunks_of(data.width, stored.tile_width) * chunks_of(data.height, stored.tile_height)
          : chunks_of(data.height, rows_of_chunk(compression));
  std::uint64_t ratio = 0;  // not known
  if (compression == "none") ratio = 1;
  if (compression.starts_with("zip")) ratio = kLargestDeflation;
  return kBytesOfChunk * chunks + (ratio == 0 ? 0 : bytes_of_samples(stored) / ratio);
}

}  // namespace

bool is_possible(const StoredPicture& stored) {
  const auto fits = [](std::int64_t number) {
    return number >= -kLargestNumber && number <= kLargestNumber;
  };
  const auto window_fits = [&](const PixelWindow& w) {
    return fits(w.x) && fits(w.y) && fits(w.width) && fits(w.height);
  };
  const auto tile_fits = [](std::int64_t side) { return side >= 0 && side <= kLargestTileSide; };
  return !stored.parts.empty() && window_fits(stored.data) && window_fits(stored.display) &&
         tile_fits(stored.tile_width) && tile_fits(stored.tile_height) &&
         (stored.tile_width == 0) == (stored.tile_height == 0);
}

void check_header(const fs::path& file, const StoredPicture& stored, const Allowances& allow) {
  check_size(file, stored.data);
  check_tiles(file, stored);
  if (stored.is_deep) refuse(file, "holds deep samples: a flat picture needed");
  if (stored.is_cube) {
    refuse(file, "the envmap attribute says cube map: convert it to latitude-longitude first");
  }
  if (stored.holds_xyz && !allow.to_rgb) {
    refuse(file, "holds CIE XYZ values: --to-rgb converts them to linear RGB");
  }
  check_windows(file, stored, allow);
  check_orientation(file, stored);
}

void check_file_length(const fs::path& file, std::uint64_t bytes, const StoredPicture& stored) {
  // Of Radiance files the decoder knows how little they can take.
  if (stored.compression.empty() && integer_levels(stored) == 0) return;
  const std::uint64_t least = integer_levels(stored) > 0
                                  ? bytes_of_samples(stored) / (kLargestPalette * kLargestDeflation)
                                  : least_bytes_of_exr(stored);
  check_length(file, bytes, least,
               fmt::format("{} x {} pixels", stored.data.width, stored.data.height));
}

void check_channels(const fs::path& file, const StoredPicture& stored,
                    const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto channel = std::ranges::find(stored.channels, name, &StoredChannel::name);
    if (channel == stored.channels.end()) refuse(file, fmt::format("has no channel {}", name));
    if (channel->type == SampleType::uint32) {
      refuse(file, fmt::format("channel {} holds uint values: half or float needed", name));
    }
    if (channel->is_subsampled) {
      refuse(file, fmt::format("channel {} is subsampled: a sample at every pixel needed", name));
    }
  }
}

int integer_levels(const StoredPicture& stored) {
  if (stored.channels.empty()) return 0;
  if (stored.channels.front().type == SampleType::uint8) return 255;
  return stored.channels.front().type == SampleType::uint16 ? 65535 : 0;
}

double decode_exponent(const StoredPicture& stored) {
  // Files round to five digits: what is meant has two.
  const double gamma = std::round(100.0 * stored.gamma) / 100.0;
  return std::isfinite(gamma) && gamma > 0.0 ? gamma : kDecodeExponent;
}

}  // namespace lightproof
