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

/// Refuses headers that cannot be read as a map: throws InputError unless the picture is flat, of
/// sane size, and fills its display window.
void check_header(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// Refuses a file that is too short for its picture, whose `spec` check_header() has passed: throws
/// InputError.
void check_file_length(const std::filesystem::path& file, const OIIO::ImageSpec& spec);

/// The index in the file of each of the named channels. Throws InputError if one is not of a type
/// that holds radiance.
std::vector<int> channel_indices(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                                 const std::vector<std::string>& names);

/// The chromaticities that a header names; none if it names none, or such as make no colour space.
std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec);

}  // namespace lightproof
