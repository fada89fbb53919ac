// The Hammersley point set: n/N beside the bits of n mirrored at the point.
#pragma once

#include <cstdint>

#include "lightproof/core/measure.h"

namespace lightproof {

/// n in base 2, mirrored at its point: in [0,1), a multiple of 2^-32.
constexpr double mirrored_bits(std::uint32_t n) {
  n = (n << 16U) | (n >> 16U);
  n = ((n & 0x00ff00ffU) << 8U) | ((n & 0xff00ff00U) >> 8U);
  n = ((n & 0x0f0f0f0fU) << 4U) | ((n & 0xf0f0f0f0U) >> 4U);
  n = ((n & 0x33333333U) << 2U) | ((n & 0xccccccccU) >> 2U);
  n = ((n & 0x55555555U) << 1U) | ((n & 0xaaaaaaaaU) >> 1U);
  return n * 0x1p-32;
}

/// The n-th of N points. s is 1 for n = N, which the lecture's loop from 1 to N asks for.
constexpr SquarePoint hammersley(std::uint32_t n, std::uint32_t count) {
  return {static_cast<double>(n) / count, mirrored_bits(n)};
}

}  // namespace lightproof
