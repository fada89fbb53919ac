// Hammersley's points (n/N, radical inverse of n) (Hammersley 1960), for N a power of two a
// (0,m,2)-net in base 2.
#pragma once

#include <cstdint>

#include "lightproof/points/point_set.h"
#include "lightproof/points/radical_inverse.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/rank_coordinate.h"

namespace lightproof {

/// Hammersley's point set in double, exact up to the quotient's rounding. The numbers are n = 0 …
/// N-1, as Hammersley has them, or n = 1 … N, as the lecture's listing of the BRDF integration map
/// counts them: there the last s, which is 1, is taken as 0, the same azimuth.
class Hammersley {
 public:
  /// The count N is in [1, 2^32]; the first number 0 or 1.
  Hammersley(std::uint64_t count, std::uint32_t first, PointSeed seed)
      : first_(first), rank_(count, shift_of(seed).s), shift_(from_fixed_point(shift_of(seed).t)) {}

  SquarePoint point(std::uint32_t index) const {
    const std::uint64_t n = std::uint64_t{index} + first_;
    return {rank_.at(n), wrapped(radical_inverse(n) + shift_)};
  }

 private:
  std::uint32_t first_;
  RankCoordinate rank_;
  double shift_;
};

/// The Hammersley points of n = 1 … N as shaders compute them in float: a quotient of floats, and
/// the mirrored bits as a float over 2^32. Its s is 1 at the end, its t from n = 2^25 - 1 on where
/// all upper bits of the mirrored word are ones.
class HammersleyFloat {
 public:
  /// The count N is in [1, 2^32]. The seed's shift is added in float.
  HammersleyFloat(std::uint64_t count, PointSeed seed)
      : exact_(count, 1, seed),
        count_(static_cast<float>(count)),
        is_shifted_(seed.has_value()),
        shift_s_(static_cast<float>(from_top_24_bits(shift_of(seed).s))),
        shift_t_(static_cast<float>(from_top_24_bits(shift_of(seed).t))) {}

  SquarePoint point(std::uint32_t index) const {
    const float s = static_cast<float>(std::uint64_t{index} + 1) / count_;
    const float t = static_cast<float>(reversed_bits(index + 1)) * 0x1p-32F;
    if (!is_shifted_) return {s, t};
    return {fract(s + shift_s_), fract(t + shift_t_)};
  }
  SquarePoint exact_point(std::uint32_t index) const { return exact_.point(index); }

 private:
  Hammersley exact_;
  float count_;
  bool is_shifted_;
  float shift_s_;
  float shift_t_;
};

}  // namespace lightproof
