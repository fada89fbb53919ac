// Which kind of picture a file is, by its first bytes. Private to the image module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace lightproof {

/// Throws InputError: "FILE: REASON".
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason);

/// A kind of file by its first bytes.
struct FileFormat {
  std::string_view magic;
  const char* plugin;  ///< OpenImageIO's name
  std::string_view name;
};

inline constexpr std::string_view kRadianceFormat = "Radiance .hdr";

/// Throws InputError if the path is missing, a folder, empty, unreadable, cut off (JPEG, PNG), or
/// neither OpenEXR, Radiance .hdr, PNG nor JPEG.
const FileFormat& recognise_file(const std::filesystem::path& file);

/// Throws InputError unless both sides are at least 1 and no larger than kLargestPicture, in either
/// order.
void check_size(const std::filesystem::path& file, std::int64_t width, std::int64_t height);

/// Throws InputError unless the file has the bytes without which `what` ("8192 scanlines") cannot
/// be: looked at before memory is taken for the pixels.
void check_length(const std::filesystem::path& file, std::uint64_t bytes, std::uint64_t least_bytes,
                  std::string_view what);

}  // namespace lightproof
