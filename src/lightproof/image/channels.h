// From the user's selection to the part and channels of a file. Private to the image module.
#pragma once

#include <filesystem>

#include "lightproof/image/picture_header.h"

namespace lightproof {

/// Throws InputError if the file has no part of this number.
int chosen_part(const std::filesystem::path& file, std::size_t parts,
                const ChannelSelection& selection);

/// Names of three channels of the header, or of one. Throws InputError that lists the channels, and
/// says how to choose, if one is missing.
std::vector<std::string> chosen_channels(const std::filesystem::path& file,
                                         const PictureHeader& header,
                                         const ChannelSelection& selection);

}  // namespace lightproof
