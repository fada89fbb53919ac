// What a file's header must say before its pixels are read. Private to the image module: it shows
// OpenImageIO's types.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/image/open_image_io.h"

namespace lightproof {

/// A kind of file by its first bytes.
struct FileFormat {
  std::string_view magic;
  const char* plugin;  ///< OpenImageIO's name
  std::string_view name;
};

/// Throws InputError if the path is missing, a folder, empty, unreadable, cut off (JPEG, PNG), or
/// neither OpenEXR, Radiance .hdr, PNG nor JPEG.
const FileFormat& recognise_file(const std::filesystem::path& file);

/// Throws InputError unless the picture is flat, of sane size, and fills its display window.
void check_header(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// Indices of R, G and B. Throws InputError listing the channels if one is missing or is not of a
/// type that holds radiance.
std::array<int, 3> rgb_channels(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// What is left out or taken as it is: further parts and channels, exposure, gamma.
std::vector<std::string> header_notes(const OIIO::ImageSpec& spec, std::array<int, 3> rgb);

}  // namespace lightproof
