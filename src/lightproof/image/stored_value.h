// How formats store single values and pixels, and what is read back. Private to the image module
// and to the decoder.
#pragma once

#include <array>
#include <cstdint>

#include "lightproof/core/direction.h"

namespace lightproof {

/// Largest finite 16-bit float.
inline constexpr double kLargestHalf = 65504.0;
/// 255 * 2^119: the largest mantissa at the largest exponent.
inline constexpr double kLargestRgbe = 0x1.fep126;

/// The bits of the nearest 16-bit float, ties to even; values beyond the largest become it.
std::uint16_t half_bits(float value);
float float_of_half(std::uint16_t bits);

/// A pixel as Radiance pictures store it: three mantissas and their common exponent.
struct RgbePixel {
  std::array<std::uint8_t, 3> mantissas;
  std::uint8_t exponent;
};

/// The value of a stored pixel: mantissa / 256 * 2^(exponent - 128), exactly; black for an exponent
/// of 0. This is what OpenImageIO and most renderers read; Radiance itself adds half a step to the
/// mantissas.
Rgb rgb_of(RgbePixel pixel);

/// The nearest mantissas at the exponent of the largest channel. Negative channels become 0, and
/// those that are too large the largest.
RgbePixel rgbe_of(Rgb rgb);

/// c / (1 + c), the curve of Reinhard et al. 2002 (equation 3), sRGB-encoded, in 0 to 255. Negative
/// values become 0.
std::uint8_t tone_mapped_byte(float value);

}  // namespace lightproof
