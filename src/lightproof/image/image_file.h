// A picture file of any format that is read: refused with a reason before its pixels are read if it
// cannot be an environment map, then read as linear RGB. Its bytes are decoded by another program,
// lightproof-decode, which has little memory and time and no way to anything else: no file can do
// more than be refused.
#pragma once

#include <filesystem>
#include <memory>

#include "lightproof/core/direction.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {

class ImageFile {
 public:
  /// Opens the file by its first bytes, whatever its extension, and checks its header. Throws
  /// InputError.
  explicit ImageFile(const std::filesystem::path& path, const ChannelSelection& selection = {},
                     const Allowances& allow = {});
  ~ImageFile();
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  /// What the file says of itself; reading the pixels may add to the notes.
  const PictureHeader& header() const;

  /// The pixels as linear RGB, row 0 at the top, flips of the header undone. Their values are not
  /// checked. Throws InputError if they cannot be read. Call it once.
  Grid<Rgb> read_pixels();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightproof
