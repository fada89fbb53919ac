// OpenEXR files as bytes: 32-bit floats, compressed without loss, the same bytes for the same
// values.
#pragma once

#include <optional>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"
#include "lightproof/image/brdf_map.h"
#include "lightproof/image/chromaticities.h"
#include "lightproof/image/map_levels.h"

namespace lightproof {

/// A picture, row 0 at the top, as scanlines of R, G and B. Attributes are strings of the header,
/// "lightproof.method".
std::string exr_bytes(const Grid<Rgb>& picture, const Attributes& attributes = {},
                      const std::optional<Chromaticities>& chromaticities = std::nullopt);

/// A latitude-longitude map with all its levels in one file: tiles of 64 x 64, MIPMAP_LEVELS,
/// rounded down. Such a file has every level down to 1 x 1: those that the map does not have are
/// means of 2 x 2 texels of the one before, and the attribute `levels` says how many are the map's.
std::string exr_mipmap_bytes(const MapLevels& map);

/// A BRDF integration map as the channels R and G.
std::string exr_bytes(const BrdfMap& map);

}  // namespace lightproof
