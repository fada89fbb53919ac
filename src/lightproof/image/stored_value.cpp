#include "lightproof/image/stored_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightproof/image/srgb.h"

namespace lightproof {
namespace {

constexpr int kExponentBias = 128;
constexpr int kMantissaBits = 8;
constexpr float kMantissas = 256.0F;
/// Bits of the significand of a 16-bit float, the implied one too.
constexpr int kHalfBits = 11;
/// The smallest normal one is 2^-14: 1/2 * 2^-13.
constexpr int kLeastHalfExponent = -13;
constexpr unsigned kHalfSign = 0x8000;

/// The nearest multiple of 2^(exponent - 8) to `value`.
float in_steps(float value, int exponent) {
  return std::nearbyint(std::ldexp(value, kMantissaBits - exponent));
}

}  // namespace

std::uint16_t half_bits(float value) {
  const unsigned sign = std::signbit(value) ? kHalfSign : 0U;
  const float size = std::min(static_cast<float>(kLargestHalf), std::abs(value));
  if (size == 0.0F) return static_cast<std::uint16_t>(sign);
  int exponent = 0;
  std::frexp(size, &exponent);
  exponent = std::max(exponent, kLeastHalfExponent);
  // In units of the last place: 1024 to 2048, less where it is denormal. The bits of a larger
  // exponent follow on those of the largest significand.
  const auto significand =
      static_cast<unsigned>(std::nearbyint(std::ldexp(size, kHalfBits - exponent)));
  const auto steps = static_cast<unsigned>(exponent - kLeastHalfExponent) << (kHalfBits - 1);
  return static_cast<std::uint16_t>(sign | (steps + significand));
}

float float_of_half(std::uint16_t bits) {
  constexpr unsigned kImplied = 1U << (kHalfBits - 1);
  const int exponent = bits >> (kHalfBits - 1) & 0x1f;
  const unsigned fraction = bits & (kImplied - 1);
  const bool is_negative = (bits & kHalfSign) != 0;
  float size = 0.0F;
  if (exponent == 0x1f) {
    size = fraction == 0 ? std::numeric_limits<float>::infinity()
                         : std::numeric_limits<float>::quiet_NaN();
  } else {
    const unsigned significand = exponent == 0 ? fraction : fraction + kImplied;
    size = std::ldexp(static_cast<float>(significand),
                      std::max(exponent, 1) - 1 + kLeastHalfExponent - kHalfBits);
  }
  return is_negative ? -size : size;
}

Rgb rgb_of(RgbePixel pixel) {
  if (pixel.exponent == 0) return Rgb(0.0F);
  const float step = std::ldexp(1.0F, pixel.exponent - (128 + 8));
  return step * Rgb(pixel.mantissas[0], pixel.mantissas[1], pixel.mantissas[2]);
}

RgbePixel rgbe_of(Rgb rgb) {
  const Rgb held = glm::clamp(rgb, Rgb(0.0F), Rgb(static_cast<float>(kLargestRgbe)));
  const float largest = std::max({held.r, held.g, held.b});
  int exponent = 0;
  if (std::frexp(largest, &exponent); in_steps(largest, exponent) == kMantissas) ++exponent;
  if (largest == 0.0F || exponent <= -kExponentBias) return {};
  const auto mantissa = [&](float v) { return static_cast<std::uint8_t>(in_steps(v, exponent)); };
  return {{mantissa(held.r), mantissa(held.g), mantissa(held.b)},
          static_cast<std::uint8_t>(exponent + kExponentBias)};
}

std::uint8_t tone_mapped_byte(float value) {
  const double c = std::max(0.0, static_cast<double>(value));
  const double mapped = std::isinf(c) ? 1.0 : c / (1.0 + c);
  return static_cast<std::uint8_t>(std::lround(255.0 * srgb_encoded(mapped)));
}

}  // namespace lightproof
