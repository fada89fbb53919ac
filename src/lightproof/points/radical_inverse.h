// Van der Corput's radical inverse in base 2: the binary digits of a number, mirrored at the point.
#pragma once

#include <cstdint>

#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// The 32 bits in reverse order.
constexpr std::uint32_t reversed_bits(std::uint32_t word) {
  word = (word >> 16U) | (word << 16U);
  word = ((word & 0xff00ff00U) >> 8U) | ((word & 0x00ff00ffU) << 8U);
  word = ((word & 0xf0f0f0f0U) >> 4U) | ((word & 0x0f0f0f0fU) << 4U);
  word = ((word & 0xccccccccU) >> 2U) | ((word & 0x33333333U) << 2U);
  return ((word & 0xaaaaaaaaU) >> 1U) | ((word & 0x55555555U) << 1U);
}

/// The radical inverse of n < 2^53 in [0,1), exactly (van der Corput 1935).
constexpr double radical_inverse(std::uint64_t n) {
  return from_fixed_point(reversed_bits(static_cast<std::uint32_t>(n))) +
         reversed_bits(static_cast<std::uint32_t>(n >> 32U)) * 0x1p-64;
}

}  // namespace lightproof
