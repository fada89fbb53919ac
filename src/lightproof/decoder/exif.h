// Exif, of which the orientation matters.
#pragma once

#include <cstdint>
#include <span>

namespace lightproof {

/// The orientation, 1 to 8, in Exif data that begin with the TIFF header ("II" or "MM"); 1 where
/// they do not say, or are damaged. Source: TIFF 6.0, tag 274.
int exif_orientation(std::span<const std::uint8_t> tiff);

}  // namespace lightproof
