// Pictures as files in memory, by OpenImageIO. Private to the image module. The file itself is then
// written by write_file(), which notices a full disk, and OpenEXR's destructors, which do not, are
// kept away from it.
#pragma once

#include <functional>
#include <string>

#include "lightproof/image/open_image_io.h"

namespace lightproof {

/// A picture in the format of OpenImageIO's name for it, "openexr". Throws InputError.
std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const void* pixels);

/// One level of a pyramid.
struct EncodedLevel {
  OIIO::ImageSpec spec;
  const void* pixels;
};

/// An OpenEXR file of so many levels; `level_of(i)` is asked for one after the other, and its
/// pixels need to live until the next call. Throws InputError.
std::string encode_exr_levels(int levels, const std::function<EncodedLevel(int)>& level_of);

}  // namespace lightproof
