// Which kind of picture a file is, by its first bytes. Private to the image module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "lightproof/image/decoder_messages.h"

namespace lightproof {

/// Refuses a file: throws InputError "FILE: REASON". The reason may hold names from the file: it is
/// written as terminal_text().
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason);

inline constexpr std::string_view kRadianceFormat = "Radiance .hdr";

/// A kind of file by its first bytes.
struct FileFormat {
  PictureFormat format;
  std::string_view magic;
  std::string_view name;
};

const FileFormat& info(PictureFormat format);

/// An open file, closed with this.
class OpenFile {
 public:
  /// Throws InputError if the path is missing, a folder, empty, or cannot be opened.
  explicit OpenFile(const std::filesystem::path& path);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// The size of the file in bytes.
  std::uint64_t size() const { return size_; }

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The format of a file by its first bytes. Throws InputError if it is none of those.
const FileFormat& recognise_file(const std::filesystem::path& path, const OpenFile& file);

/// Refuses a file that is too short, before memory is taken for its pixels: throws InputError
/// unless it has the bytes without which `what` ("8192 scanlines") cannot be.
void check_length(const std::filesystem::path& file, std::uint64_t bytes, std::uint64_t least_bytes,
                  std::string_view what);

}  // namespace lightproof
