// Maps with levels as the files that engines load. Each file is complete or not there at all; a
// folder of them becomes so by core/atomic_file.h or report/result_folder.h.
//
//   format  latlong                           cube, cube-mirrored
//   exr     STEM.exr, all levels as mipmaps   a file a level and face
//   ktx2    STEM.ktx2, all levels             STEM.ktx2, all levels and faces
//   hdr     a file a level                    a file a level and face
//   png     a file a level                    a file a level and face
//
// Files of single levels and faces have the names that Filament's cmgen gives them: STEM_m2_px.exr
// is the face +X of level 2. "_m2" is left out where there is one level only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lightproof/image/brdf_map.h"
#include "lightproof/image/map_format.h"
#include "lightproof/image/map_levels.h"

namespace lightproof {

/// The names of the files that write_map() makes.
std::vector<std::string> map_file_names(const std::string& stem, Projection projection, int levels,
                                        MapFormat format);

/// Writes a map into a folder that exists. EXR and KTX 2.0 files hold linear values, as do .hdr
/// files; PNG files hold c / (1 + c), sRGB-encoded, and say so. All files hold the map's
/// attributes. Throws InputError, before anything is written, if the map has values that the format
/// cannot hold (loss_in() and describe() tell beforehand), and if a file cannot be written.
void write_map(const std::filesystem::path& folder, const std::string& stem, const MapLevels& map,
               MapFormat format, OutOfRange out_of_range = OutOfRange::refused);

/// Whether a BRDF integration map can be written in a format: not as .hdr, whose common exponent
/// would leave B, which is small beside A, with few digits.
bool holds_brdf_map(MapFormat format);

/// The format itself, or EXR where it cannot hold a BRDF integration map.
MapFormat brdf_format(MapFormat format);

/// Writes STEM.exr (32-bit floats), STEM.ktx2 (16-bit floats) or STEM.png (8 bits, A in red, B in
/// green, not encoded). Throws InputError if the file cannot be written, if the format is .hdr, or
/// if a value is not finite.
void write_brdf_map(const std::filesystem::path& folder, const std::string& stem,
                    const BrdfMap& map, MapFormat format);

}  // namespace lightproof
