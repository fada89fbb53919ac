#include "lightproof/image/stored_value.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

#include "lightproof/image/srgb.h"

namespace lightproof {
namespace {

constexpr int kExponentBias = 128;
constexpr int kMantissaBits = 8;
constexpr float kMantissas = 256.0F;

/// The nearest multiple of 2^(exponent - 8) to `value`.
float in_steps(float value, int exponent) {
  return std::nearbyint(std::ldexp(value, kMantissaBits - exponent));
}

}  // namespace

std::uint16_t half_bits(float value) {
  constexpr auto kLargest = static_cast<float>(kLargestHalf);
  return half(std::clamp(value, -kLargest, kLargest)).bits();
}

float float_of_half(std::uint16_t bits) {
  half value;
  value.setBits(bits);
  return value;
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
