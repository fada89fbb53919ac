// Numbers of [0,1), from fixed-point words and as remainders modulo 1.
#pragma once

#include <cmath>
#include <cstdint>

namespace lightproof {

/// word / 2^32, exactly. As a float it would be 1 for the last 128 words.
constexpr double from_fixed_point(std::uint32_t word) { return word * 0x1p-32; }

/// The top 24 bits of a word: as many as a float holds in equal steps, so that the largest number
/// is 1 - 2^-24 in float as in double.
constexpr double from_top_24_bits(std::uint32_t word) { return (word >> 8U) * 0x1p-24; }

/// The remainder modulo 1 of a number of [0,2).
constexpr double wrapped(double x) { return x >= 1.0 ? x - 1.0 : x; }

/// x - floor(x) in float, as the shading languages define fract. Exact and below 1 for x >= 0; 1
/// for x in (-2^-25, 0), where the difference rounds up.
inline float fract(float x) { return x - std::floor(x); }

}  // namespace lightproof
