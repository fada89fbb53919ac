// What the header of a picture file must say before its pixels are read. Private to the image
// module.
#pragma once

#include <cstdint>
#include <filesystem>

#include "lightproof/image/picture_header.h"
#include "lightproof/image/stored_picture.h"

namespace lightproof {

/// Whether all numbers are such as a file can hold: nothing that is computed of them overflows.
bool is_possible(const StoredPicture& stored);

/// Refuses pictures that cannot be read as a map: throws InputError, which names the flag that
/// would help, unless the picture is flat, of sane size, and fills its display window.
void check_header(const std::filesystem::path& file, const StoredPicture& stored,
                  const Allowances& allow);

/// Refuses a file that is too short for its picture, which check_header() has passed: throws
/// InputError.
void check_file_length(const std::filesystem::path& file, std::uint64_t bytes,
                       const StoredPicture& stored);

/// Refuses channels that cannot hold radiance: throws InputError.
void check_channels(const std::filesystem::path& file, const StoredPicture& stored,
                    const std::vector<std::string>& names);

/// The greatest value of an integer format; 0 for a floating-point one, which is linear already.
int integer_levels(const StoredPicture& stored);

/// What the values of an integer format are raised to: 2.2 unless the file names another gamma.
double decode_exponent(const StoredPicture& stored);

}  // namespace lightproof
