// Counter-based random numbers: the n-th point of a stream depends only on the base seed, the
// stream's name and n, so any split of the work over threads or machines draws the same numbers.
// Generator: Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
#pragma once

#include <Random123/philox.h>

#include <cstdint>
#include <string_view>

#include "lightproof/core/measure.h"

namespace lightproof {

/// 64-bit FNV-1a of the text; the stable name of a test, map or stream.
constexpr std::uint64_t hash_text(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

/// A number in [0, 1), never 1, of the upper 53 of 64 random bits.
constexpr double unit_interval(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t bits = (std::uint64_t{high} << 32U) | low;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// An endless stream of independent uniform points of [0,1)^2, addressed by index.
class RandomStream {
 public:
  RandomStream(std::string_view name, std::uint64_t base_seed, std::uint64_t substream = 0)
      : key_(hash_text(name) ^ mix(base_seed)), substream_(substream) {}

  /// A stream with the same key whose numbers are independent of this one's.
  RandomStream substream(std::uint64_t number) const {
    RandomStream other = *this;
    other.substream_ = number;
    return other;
  }

  /// The key of the stream's generator, made of its name and the base seed.
  std::uint64_t key() const { return key_; }
  /// Which of the independent streams of its key this one is.
  std::uint64_t number() const { return substream_; }

  /// The point of this index, of 53 random bits a coordinate.
  SquarePoint point(std::uint64_t index) const {
    const r123::Philox4x32::ctr_type counter = {
        {low(index), high(index), low(substream_), high(substream_)}};
    const r123::Philox4x32::key_type key = {{low(key_), high(key_)}};
    const auto bits = r123::Philox4x32{}(counter, key);
    return {unit_interval(bits[0], bits[1]), unit_interval(bits[2], bits[3])};
  }

 private:
  static constexpr std::uint32_t low(std::uint64_t v) { return static_cast<std::uint32_t>(v); }
  static constexpr std::uint32_t high(std::uint64_t v) {
    return static_cast<std::uint32_t>(v >> 32U);
  }
  /// SplitMix64's finaliser, so that neighbouring seeds give unrelated keys.
  static constexpr std::uint64_t mix(std::uint64_t v) {
    v += 0x9e3779b97f4a7c15ULL;
    v = (v ^ (v >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    v = (v ^ (v >> 27U)) * 0x94d049bb133111ebULL;
    return v ^ (v >> 31U);
  }

  std::uint64_t key_;
  std::uint64_t substream_;
};

}  // namespace lightproof
