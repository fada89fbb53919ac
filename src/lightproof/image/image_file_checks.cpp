#include "lightproof/image/image_file_checks.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

#include "lightproof/image/image_file.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr FileFormat kFormats[] = {
    {"\x76\x2f\x31\x01", "openexr", "OpenEXR"},
    {"#?", "hdr", "Radiance .hdr"},
    {"\x89PNG\r\n\x1a\n", "png", "PNG"},
    {"\xff\xd8\xff", "jpeg", "JPEG"},
};
constexpr std::size_t kListedChannels = 32;
constexpr std::int64_t kLargestTile = std::int64_t{4096} * 4096;

std::uintmax_t regular_file_size(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) refuse(file, "no such file");
  if (error) refuse(file, error.message());
  if (status.type() == fs::file_type::directory) refuse(file, "is a folder, a picture needed");
  if (status.type() != fs::file_type::regular) refuse(file, "is not a regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) refuse(file, error.message());
  return size;
}

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// Whether the end marker follows the start of the compressed data, inside which it cannot occur.
/// libjpeg fills the missing part of a cut-off file with grey and calls that a warning.
bool has_jpeg_end(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 3 < bytes.size() && byte_at(bytes, at) == 0xff && byte_at(bytes, at + 1) != 0xda) {
    const bool is_padding = byte_at(bytes, at + 1) == 0xff;
    at += is_padding ? 1 : 2 + 256 * byte_at(bytes, at + 2) + byte_at(bytes, at + 3);
  }
  return bytes.find("\xff\xd9", at) != std::string_view::npos;
}

/// Whether the chunks go on to IEND. OpenImageIO notices a missing end too, but leaks memory.
bool has_png_end(std::string_view bytes) {
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = 256 * length + byte_at(bytes, at + i);
    at += 12 + length;
  }
  return false;
}

/// OpenEXR and Radiance readers report a cut-off file themselves.
bool is_whole(std::ifstream& stream, const FileFormat& format) {
  if (format.name != "JPEG" && format.name != "PNG") return true;
  stream.clear();
  stream.seekg(0);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return format.name == "JPEG" ? has_jpeg_end(bytes) : has_png_end(bytes);
}

void check_size(const fs::path& file, const OIIO::ImageSpec& spec) {
  const bool sane = spec.width >= 1 && spec.height >= 1 && spec.depth <= 1;
  const int longer = std::max(spec.width, spec.height);
  const int shorter = std::min(spec.width, spec.height);
  if (!sane || longer > kLargestPicture.width || shorter > kLargestPicture.height) {
    refuse(file,
           fmt::format("the header says {} x {} x {} pixels: 1 x 1 to {} x {} are read", spec.width,
                       spec.height, spec.depth, kLargestPicture.width, kLargestPicture.height));
  }
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

/// Radiance .hdr and Exif can also store columns as rows; readers differ in what they make of it.
void check_orientation(const fs::path& file, const OIIO::ImageSpec& spec) {
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation >= 0 && orientation <= 4) return;
  refuse(file, fmt::format("the header says orientation {}, a quarter turn or columns stored as "
                           "rows: store it row by row first",
                           orientation));
}

/// A file of CIE XYZ values declares (1, 0) and (0, 1) as the chromaticities of its "R" and "G".
bool holds_xyz(const OIIO::ImageSpec& spec) {
  float xy[8] = {};
  return spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy) &&
         xy[0] == 1.0F && xy[1] == 0.0F && xy[2] == 0.0F && xy[3] == 1.0F;
}

/// "R, G, B, A"; a header may name thousands, so the list ends somewhere.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kListedChannels) return text + ", …";
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return text;
}

}  // namespace

const FileFormat& recognise_file(const fs::path& file) {
  if (regular_file_size(file) == 0) refuse(file, "the file is empty (0 bytes)");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, std::generic_category().message(errno));
  std::string head(8, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  for (const FileFormat& format : kFormats) {
    if (!head.starts_with(format.magic)) continue;
    if (!is_whole(stream, format)) {
      refuse(file, fmt::format("cannot be read as {}: the file is cut off before its end marker",
                               format.name));
    }
    return format;
  }
  refuse(file, "not a picture that is read here: OpenEXR, Radiance .hdr, PNG or JPEG needed");
}

void check_header(const fs::path& file, const OIIO::ImageSpec& spec) {
  check_size(file, spec);
  if (spec.deep) refuse(file, "holds deep samples: a flat picture needed");
  if (spec.get_string_attribute("textureformat") == "CubeFace Environment") {
    refuse(file, "the envmap attribute says cube map: convert it to latitude-longitude first");
  }
  if (holds_xyz(spec)) refuse(file, "holds CIE XYZ values: convert it to linear RGB first");
  check_windows(file, spec);
  check_orientation(file, spec);
}

std::array<int, 3> rgb_channels(const fs::path& file, const OIIO::ImageSpec& spec) {
  const std::array rgb = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (std::ranges::min(rgb) < 0) {
    const int parts = spec.get_int_attribute("oiio:subimages", 1);
    refuse(file, fmt::format("channels R, G and B needed, found {}{}", listed(spec.channelnames),
                             parts > 1 ? fmt::format(" in the first of {} parts", parts) : ""));
  }
  for (const int channel : rgb) {
    const OIIO::TypeDesc type = spec.channelformat(channel);
    const bool is_picture = type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16;
    if (is_picture || type.is_floating_point()) continue;
    refuse(file, fmt::format("channel {} holds {} values: half or float needed",
                             spec.channel_name(channel), type.c_str()));
  }
  return rgb;
}

std::vector<std::string> header_notes(const OIIO::ImageSpec& spec, std::array<int, 3> rgb) {
  std::vector<std::string> notes;
  const int parts = spec.get_int_attribute("oiio:subimages", 1);
  if (parts > 1) notes.push_back(fmt::format("The first of {} parts was read.", parts));
  std::vector<std::string> others;
  for (int channel = 0; channel < spec.nchannels; ++channel) {
    if (!std::ranges::count(rgb, channel)) others.push_back(spec.channel_name(channel));
  }
  if (!others.empty()) {
    notes.push_back(fmt::format("Channels left out: {}.", listed(others)));
  }
  if (const float exposure = spec.get_float_attribute("hdr:exposure", 1.0F); exposure != 1.0F) {
    notes.push_back(fmt::format("EXPOSURE={} in the header was not divided out.", exposure));
  }
  if (spec.format.is_floating_point() && spec.get_float_attribute("oiio:Gamma", 1.0F) != 1.0F) {
    notes.push_back("The gamma in the header was not undone: the values are taken as linear.");
  }
  return notes;
}

}  // namespace lightproof
