// KTX 2.0 files of 16-bit floats. Written here, since the format is small and Debian has no library
// for it: https://registry.khronos.org/KTX/specs/2.0/ktxspec.v2.html, and for the data format
// descriptor the Khronos Data Format Specification 1.3, chapter 5.
#pragma once

#include <string>

#include "lightproof/image/brdf_map.h"
#include "lightproof/image/map_levels.h"

namespace lightproof {

/// All levels and faces as one texture: VK_FORMAT_R16G16B16A16_SFLOAT with alpha 1, linear, origin
/// at the top left ("rd"), not compressed. The color primaries are named where the format has a
/// name for them. Attributes are keys and values, "lightproof.method". Values beyond 16-bit floats
/// are clamped: check_range() in image/map_format.h says whether there are any.
std::string ktx2_bytes(const MapLevels& map);

/// A BRDF integration map as VK_FORMAT_R16G16_SFLOAT: roughness grows downwards.
std::string ktx2_bytes(const BrdfMap& map);

}  // namespace lightproof
