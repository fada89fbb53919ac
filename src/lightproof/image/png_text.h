// Attributes in PNG files, as chunks of UTF-8 text (iTXt): OpenImageIO writes tEXt, which is
// Latin-1. Private to the image module.
#pragma once

#include <string>

#include "lightproof/image/attribute.h"

namespace lightproof {

/// The PNG file with a chunk an attribute behind its header.
std::string with_text(std::string png, const Attributes& attributes);

}  // namespace lightproof
