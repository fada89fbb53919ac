// A picture file opened through OpenImageIO: refused with a reason before its pixels are read if it
// cannot be an environment map, then read as linear RGB.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Largest picture that is read; beyond it a header is taken for damaged.
inline constexpr Extent kLargestPicture = {32768, 16384};

/// Throws InputError: "FILE: REASON".
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason);

class ImageFile {
 public:
  /// Opens the file by its first bytes, whatever its extension, and checks its header. Throws
  /// InputError.
  explicit ImageFile(const std::filesystem::path& path);
  ~ImageFile();
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  /// In pixels.
  Extent extent() const;
  /// Whether the `envmap` attribute of an OpenEXR file says latitude-longitude.
  bool says_lat_long() const;
  /// What the reader assumed, one sentence each.
  const std::vector<std::string>& notes() const;

  /// Linear RGB, row 0 at the top, flips of the header undone. Values are not checked. Throws
  /// InputError.
  Grid<Rgb> read_pixels();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightproof
