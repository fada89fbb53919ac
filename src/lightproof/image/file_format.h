// Which kind of picture a file is, by its first bytes. Private to the image module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace lightproof {

/// Refuses a file: throws InputError "FILE: REASON".
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason);

/// A kind of file by its first bytes.
struct FileFormat {
  std::string_view magic;
  const char* plugin;  ///< OpenImageIO's name
  std::string_view name;
};

inline constexpr std::string_view kRadianceFormat = "Radiance .hdr";

/// The format of a file by its first bytes. Throws InputError if the path is missing, a folder,
/// empty, unreadable, cut off (JPEG, PNG), or neither OpenEXR, Radiance .hdr, PNG nor JPEG.
const FileFormat& recognise_file(const std::filesystem::path& file);

/// Refuses a picture of impossible size: throws InputError unless both sides are at least 1 and no
/// larger than those of kLargestPicture, in either order.
void check_size(const std::filesystem::path& file, std::int64_t width, std::int64_t height);

/// Refuses a file that is too short, before memory is taken for its pixels: throws InputError
/// unless it has the bytes without which `what` ("8192 scanlines") cannot be.
void check_length(const std::filesystem::path& file, std::uint64_t bytes, std::uint64_t least_bytes,
                  std::string_view what);

}  // namespace lightproof
