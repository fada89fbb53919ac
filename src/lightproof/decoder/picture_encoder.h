// Files of pictures, made in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "lightproof/image/decoder_messages.h"

namespace lightproof {

/// Fills the span with the samples that come next, row by row, level by level.
using NextSamples = std::function<void(std::span<std::byte>)>;

/// Scanlines, or tiles with levels, of 32-bit floats, compressed without loss (ZIP); the same
/// samples give the same bytes. Attributes are strings of the header.
std::string exr_file(const EncodeRequest& request, const NextSamples& next);
/// 32-bit_rle_rgbe. Attributes are comments of the header.
std::string radiance_file(const EncodeRequest& request, const NextSamples& next);
/// 8 bits a channel, sRGB. Attributes are texts in UTF-8 (iTXt).
std::string png_file(const EncodeRequest& request, const NextSamples& next);

}  // namespace lightproof
