// Additive recurrences x_n = frac(start + n alpha) with an irrational alpha (Kronecker 1884, Weyl
// 1916), in fixed point: the whole 32-bit word is the fraction, and its overflow the remainder.
#pragma once

#include <bit>
#include <cstdint>

namespace lightproof {

/// An alpha of (0,1), rounded to a multiple of 2^-64.
struct Alpha {
  std::uint64_t fraction;  ///< in units of 2^-64

  constexpr double value() const { return static_cast<double>(fraction) * 0x1p-64; }
};

/// The metallic numbers' fractional parts, roots of a^2 + k a = 1: (sqrt(k^2 + 4) - k) / 2.
inline constexpr Alpha kGolden = {0x9e3779b97f4a7c16U};  ///< k = 1
inline constexpr Alpha kSilver = {0x6a09e667f3bcc909U};  ///< k = 2
inline constexpr Alpha kBronze = {0x4d82b446159f3610U};  ///< k = 3

/// 1/g and 1/g^2 for the plastic number g, g^3 = g + 1: the sequence R2 of Roberts 2018, "The
/// Unreasonable Effectiveness of Quasirandom Sequences".
inline constexpr Alpha kPlastic = {0xc13fa9a902a6328fU};
inline constexpr Alpha kPlasticSquared = {0x91e10da5c79e7b1dU};

/// alpha in units of 2^-32, rounded to the nearest.
constexpr std::uint32_t nearest_step(Alpha alpha) {
  return static_cast<std::uint32_t>((alpha.fraction + 0x80000000U) >> 32U);
}

/// alpha in units of 2^-32, rounded to the nearest odd number: 2^32 numbers without repetition.
constexpr std::uint32_t nearest_odd_step(Alpha alpha) {
  return static_cast<std::uint32_t>(alpha.fraction >> 32U) | 1U;
}

/// After how many numbers the recurrence with this step, not 0, repeats.
constexpr std::uint64_t period(std::uint32_t step) {
  return std::uint64_t{1} << (32U - static_cast<unsigned>(std::countr_zero(step)));
}

/// start + n step modulo 2^32.
struct AdditiveRecurrence {
  std::uint32_t step;
  std::uint32_t start;

  constexpr std::uint32_t at(std::uint32_t n) const { return start + n * step; }
};

/// frac(start + n alpha) to 2^-32: n steps of 2^-64 each are off by half of that at most. The start
/// is in units of 2^-32.
constexpr double exact_fraction(Alpha alpha, std::uint32_t start, std::uint32_t n) {
  const std::uint64_t sum = (std::uint64_t{start} << 32U) + n * alpha.fraction;
  return static_cast<double>(sum >> 11U) * 0x1p-53;
}

}  // namespace lightproof
