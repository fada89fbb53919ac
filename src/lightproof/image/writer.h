// Pictures to files, each complete or not there at all.
#pragma once

#include <filesystem>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"

namespace lightproof {

/// Pictures have row 0 at the top, unlike maps.
/// 32-bit float OpenEXR. Throws InputError if it cannot be written.
void write_exr(const std::filesystem::path& file, const Grid<Rgb>& picture);

/// 8-bit PNG of values in [0,1] that are sRGB-encoded already; out-of-range values are clamped.
void write_png(const std::filesystem::path& file, const Grid<Rgb>& picture);

/// The same PNG as bytes in memory, with attributes as texts of its header.
std::string png_bytes(const Grid<Rgb>& picture, const Attributes& attributes = {});

/// The rows of a map or picture in reverse order: map to picture and back.
Grid<Rgb> flip_rows(const Grid<Rgb>& grid);

}  // namespace lightproof
