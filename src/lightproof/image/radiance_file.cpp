#include "lightproof/image/radiance_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/core/parallel.h"
#include "lightproof/image/channels.h"
#include "lightproof/image/file_format.h"
#include "lightproof/image/radiance_scanlines.h"

namespace lightproof {
namespace {

PictureHeader picture_header(const ByteReader& bytes, const RadianceHeader& radiance,
                             const ChannelSelection& selection) {
  PictureHeader header;
  header.format = kRadianceFormat;
  header.extent = radiance.resolution.extent();
  header.parts = {""};
  header.part = chosen_part(bytes.file(), header.parts.size(), selection);
  header.channels = {"R", "G", "B"};
  header.read = chosen_channels(bytes.file(), header, selection);
  const RadianceResolution& r = radiance.resolution;
  if (r.columns || r.scanlines_backwards || r.pixels_backwards) header.orientation = r.text();
  header.chromaticities = radiance.primaries;
  header.exposure = radiance.exposure;
  header.notes = notes_of(radiance);
  return header;
}

/// Where the pixels of a scanline go, as shown.
struct Place {
  int column;
  int row;
};

Place place_of(const RadianceResolution& r, int scanline, int pixel) {
  const int slow = r.scanlines_backwards ? r.scanlines - 1 - scanline : scanline;
  const int fast = r.pixels_backwards ? r.pixels - 1 - pixel : pixel;
  return r.columns ? Place{slow, fast} : Place{fast, slow};
}

}  // namespace

RadianceFile::RadianceFile(const std::filesystem::path& file, const ChannelSelection& selection)
    : bytes_(file),
      radiance_(read_radiance_header(bytes_)),
      header_(picture_header(bytes_, radiance_, selection)) {
  const RadianceResolution& r = radiance_.resolution;
  check_length(file, bytes_.size() - bytes_.position(), least_bytes(r),
               fmt::format("{} scanlines of {} pixels", r.scanlines, r.pixels));
}

Grid<Rgb> RadianceFile::read_pixels() {
  const RadianceResolution& r = radiance_.resolution;
  // Not touched before it is decoded: a damaged header costs address space, no memory.
  Grid<Rgb> picture = Grid<Rgb>::without_values(r.extent());
  std::array<int, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& name = header_.read[i % header_.read.size()];
    channels[i] =
        static_cast<int>(std::ranges::find(header_.channels, name) - header_.channels.begin());
  }
  RadianceScanlines scanlines(bytes_, r);
  for (int y = 0; y < r.scanlines; ++y) {
    throw_if_interrupted();
    const auto pixels = scanlines.next();
    for (int x = 0; x < r.pixels; ++x) {
      const Place at = place_of(r, y, x);
      const Rgb rgb = rgb_of(pixels[static_cast<std::size_t>(x)]);
      picture(at.column, at.row) = {rgb[channels[0]], rgb[channels[1]], rgb[channels[2]]};
    }
  }
  if (const std::uint64_t rest = bytes_.size() - bytes_.position(); rest > 0) {
    header_.notes.push_back(fmt::format("{} bytes after the picture were ignored.", rest));
  }
  return picture;
}

}  // namespace lightproof
