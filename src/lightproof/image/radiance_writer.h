// Radiance .hdr pictures to files.
#pragma once

#include <optional>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"
#include "lightproof/image/chromaticities.h"

namespace lightproof {

/// A picture (row 0 at the top) as a file of 32-bit_rle_rgbe: every channel is rounded to the
/// nearest of 256 steps below the power of two above the texel's largest one, so with an error of
/// at most 1/256 of that. The planes of scanlines are run-length coded where the format allows it,
/// from 8 to 32767 pixels. Attributes are comments of the header, "# lightproof.method=…", which
/// other readers pass over; PRIMARIES names the chromaticities, Rec. 709 if there are none. Values
/// beyond the format are clamped: check_range() in image/map_format.h says whether there are any.
std::string radiance_bytes(const Grid<Rgb>& picture, const Attributes& attributes = {},
                           const std::optional<Chromaticities>& chromaticities = std::nullopt);

}  // namespace lightproof
