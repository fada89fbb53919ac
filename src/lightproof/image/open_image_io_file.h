// A picture that OpenImageIO decodes: OpenEXR, PNG, JPEG. Private to the image module: image_file.h
// is what others see.
#pragma once

#include <filesystem>
#include <memory>

#include "lightproof/core/direction.h"
#include "lightproof/image/file_format.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {

class OpenImageIoFile {
 public:
  /// Opens the file and checks its header. Throws InputError, or whatever the decoder throws.
  OpenImageIoFile(const std::filesystem::path& file, const FileFormat& format,
                  const ChannelSelection& selection);
  ~OpenImageIoFile();
  OpenImageIoFile(const OpenImageIoFile&) = delete;
  OpenImageIoFile& operator=(const OpenImageIoFile&) = delete;

  const PictureHeader& header() const;
  /// The pixels as linear RGB, row 0 at the top. Throws InputError, or whatever the decoder throws.
  Grid<Rgb> read_pixels();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The first line of what a library reported, for a message of one line.
std::string first_line(std::string text);

}  // namespace lightproof
