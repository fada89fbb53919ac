#include "lightproof/image/file_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "lightproof/core/error.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr FileFormat kFormats[] = {
    {"\x76\x2f\x31\x01", "openexr", "OpenEXR"},
    {"#?", "hdr", kRadianceFormat},
    {"\x89PNG\r\n\x1a\n", "png", "PNG"},
    {"\xff\xd8\xff", "jpeg", "JPEG"},
};

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

/// The readers of OpenEXR and Radiance files report a cut-off one themselves.
bool is_whole(std::ifstream& stream, const FileFormat& format) {
  if (format.name != "JPEG" && format.name != "PNG") return true;
  stream.clear();
  stream.seekg(0);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return format.name == "JPEG" ? has_jpeg_end(bytes) : has_png_end(bytes);
}

}  // namespace

void refuse(const fs::path& file, std::string_view reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

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

void check_size(const fs::path& file, std::int64_t width, std::int64_t height) {
  const auto [shorter, longer] = std::minmax(width, height);
  if (shorter >= 1 && longer <= kLargestPicture.width && shorter <= kLargestPicture.height) return;
  refuse(file, fmt::format("the header says {} x {} pixels: 1 x 1 to {} x {} are read", width,
                           height, kLargestPicture.width, kLargestPicture.height));
}

void check_length(const fs::path& file, std::uint64_t bytes, std::uint64_t least_bytes,
                  std::string_view what) {
  if (bytes >= least_bytes) return;
  refuse(file, fmt::format("the file is cut off or its header is damaged: {} take at least {} "
                           "bytes, and the file has {}",
                           what, least_bytes, bytes));
}

}  // namespace lightproof
