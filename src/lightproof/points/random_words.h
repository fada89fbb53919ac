// The random bits with which a seed shifts, scrambles or keys a point set.
#pragma once

#include <cstdint>

#include "lightproof/core/random.h"
#include "lightproof/points/point_set.h"

namespace lightproof {

/// A seed of 64 independent bits: the top 32 of each coordinate of a point of the stream.
inline std::uint64_t seed_from(const RandomStream& stream, std::uint64_t index) {
  const SquarePoint point = stream.point(index);
  return (static_cast<std::uint64_t>(point.s * 0x1p32) << 32U) |
         static_cast<std::uint64_t>(point.t * 0x1p32);
}

/// A pair of 32-bit words.
struct WordPair {
  std::uint32_t s = 0;
  std::uint32_t t = 0;
};

/// Independent uniform words, a function of the seed alone.
inline WordPair random_words(std::uint64_t seed) {
  const std::uint64_t bits = seed_from(RandomStream("points/seed", seed), 0);
  return {static_cast<std::uint32_t>(bits >> 32U), static_cast<std::uint32_t>(bits)};
}

/// By how much a seed shifts a point set, in units of 2^-32; zero without one.
inline WordPair shift_of(PointSeed seed) { return seed ? random_words(*seed) : WordPair{}; }

}  // namespace lightproof
