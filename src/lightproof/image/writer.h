// Pictures to files, each complete or not there at all. Pictures have row 0 at the top, unlike
// maps.
#pragma once

#include <filesystem>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"

namespace lightproof {

/// Writes a 32-bit float OpenEXR file. Throws InputError if it cannot be written.
void write_exr(const std::filesystem::path& file, const Grid<Rgb>& picture);

/// Writes an 8-bit PNG file of values in [0,1] that are sRGB-encoded already; out-of-range values
/// are clamped. Throws InputError if it cannot be written.
void write_png(const std::filesystem::path& file, const Grid<Rgb>& picture);

/// The bytes of the 8-bit PNG file that write_png() writes, with attributes as texts of its header.
std::string png_bytes(const Grid<Rgb>& picture, const Attributes& attributes = {});

/// The rows of a map or picture in reverse order: map to picture and back.
Grid<Rgb> flip_rows(const Grid<Rgb>& grid);

}  // namespace lightproof
