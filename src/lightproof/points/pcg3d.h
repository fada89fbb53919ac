// The hash pcg3d (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3)), which
// turns pixel and frame into three random words.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "lightproof/points/point_set.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// A linear congruential step of each word, two rounds in which each is mixed with the product of
/// the other two, and between the rounds the upper halves folded into the lower ones. A bijection.
constexpr std::array<std::uint32_t, 3> pcg3d(std::array<std::uint32_t, 3> v) {
  const auto mix = [&v] {
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
  };
  for (std::uint32_t& word : v) word = word * 1664525U + 1013904223U;
  mix();
  for (std::uint32_t& word : v) word ^= word >> 16U;
  mix();
  return v;
}

/// How a shader counts the frames that it hands to the hash.
enum class FrameIndex {
  whole,      ///< as a whole number of 32 bits
  converted,  ///< whole, but handed on as a float, which rounds it from 2^24 on
  counted,    ///< as a float that grows by 1 each frame, and stands still at 2^24
};

/// The frame index as the hash sees it.
template <FrameIndex kIndex>
constexpr std::uint32_t seen_by_shader(std::uint32_t index) {
  if constexpr (kIndex == FrameIndex::counted) return std::min(index, std::uint32_t{1} << 24U);
  if constexpr (kIndex == FrameIndex::converted) {
    // The last 128 indices round to 2^32, which is outside of 32 bits; hardware clamps.
    const auto converted = static_cast<std::uint64_t>(static_cast<float>(index));
    return static_cast<std::uint32_t>(std::min(converted, kMostPoints - 1));
  }
  return index;
}

/// The top 24 bits of two words of the hash of (x, y, index), where the seed gives the pixel (x,
/// y).
template <FrameIndex kIndex>
class Pcg3dPoints {
 public:
  explicit Pcg3dPoints(PointSeed seed) : pixel_(random_words(seed.value_or(0))) {}

  SquarePoint point(std::uint32_t index) const { return hashed(seen_by_shader<kIndex>(index)); }
  /// What the point would be if no index were rounded.
  SquarePoint exact_point(std::uint32_t index) const { return hashed(index); }

 private:
  SquarePoint hashed(std::uint32_t index) const {
    const auto words = pcg3d({pixel_.s, pixel_.t, index});
    return {from_top_24_bits(words[0]), from_top_24_bits(words[1])};
  }

  WordPair pixel_;
};

}  // namespace lightproof
