// Choices without branches: where what is chosen depends on random numbers, a processor guesses a
// branch wrongly half the time, and cannot go on to the next sample's look-ups before it knows.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

namespace lightproof {

/// `yes` if the condition holds, else `no`; both are evaluated.
template <std::unsigned_integral Integer>
Integer select(bool condition, Integer yes, Integer no) {
  const Integer mask = Integer{0} - static_cast<Integer>(condition);
  return (yes & mask) | (no & ~mask);
}

/// `yes` if the condition holds, else `no`; both are evaluated.
inline double select(bool condition, double yes, double no) {
  return std::bit_cast<double>(
      select(condition, std::bit_cast<std::uint64_t>(yes), std::bit_cast<std::uint64_t>(no)));
}

/// The number with its sign changed if the condition holds.
inline double negate_if(bool condition, double value) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^
                               (static_cast<std::uint64_t>(condition) << 63U));
}

/// A number below 2^63 as a double, as quickly as a signed one.
inline double to_double(std::uint64_t number) {
  return static_cast<double>(static_cast<std::int64_t>(number));
}

}  // namespace lightproof
