// A Radiance .hdr picture. Private to the image module: image_file.h is what others see.
#pragma once

#include <filesystem>

#include "lightproof/core/direction.h"
#include "lightproof/image/byte_reader.h"
#include "lightproof/image/picture_header.h"
#include "lightproof/image/radiance_header.h"

namespace lightproof {

class RadianceFile {
 public:
  /// Reads the header. Throws InputError if it is damaged, or the selection is not there.
  RadianceFile(const std::filesystem::path& file, const ChannelSelection& selection);

  const PictureHeader& header() const { return header_; }
  /// The pixels as linear RGB, as they are stored: exposure and colour correction are left in. Row
  /// 0 at the top. Notes what follows the pixels. Throws InputError with scanline and byte.
  Grid<Rgb> read_pixels();

 private:
  ByteReader bytes_;
  RadianceHeader radiance_;
  PictureHeader header_;
};

}  // namespace lightproof
