// From the user's selection to the part and channels of a file. Private to the image module.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lightproof/image/picture_header.h"

namespace lightproof {

/// The number of the part that the selection names, the first one if it names none. Throws
/// InputError if the file has no part of this number.
int chosen_part(const std::filesystem::path& file, std::size_t parts,
                const ChannelSelection& selection);

/// Luminance and two differences from it, by which OpenEXR files may store colours.
inline const std::vector<std::string> kLuminanceChroma = {"Y", "RY", "BY"};

/// Whether a file has these channels and no R, G and B, and the selection names no others.
bool holds_luminance_chroma(const PictureHeader& header, const ChannelSelection& selection);

/// The full names of the channels that are read: three of the header, or one. Throws InputError
/// that lists the channels, and says how to choose, if one is missing.
std::vector<std::string> chosen_channels(const std::filesystem::path& file,
                                         const PictureHeader& header,
                                         const ChannelSelection& selection);

}  // namespace lightproof
