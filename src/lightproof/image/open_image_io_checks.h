// What the header of an OpenEXR, PNG or JPEG file must say before its pixels are read. Private to
// the image module: it shows OpenImageIO's types.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/image/chromaticities.h"
#include "lightproof/image/open_image_io.h"

namespace lightproof {

/// Throws InputError unless the picture is flat, of sane size, and fills its display window.
void check_header(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// Throws InputError if the file is too short for the picture: `spec` as check_header() passes it.
void check_file_length(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// Index of each channel. Throws InputError if one is not of a type that holds radiance.
std::vector<int> channel_indices(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                                 const std::vector<std::string>& names);

/// None if the header says nothing, or what makes no colour space.
std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec);

}  // namespace lightproof
