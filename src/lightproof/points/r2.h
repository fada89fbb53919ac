// R2 (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"): the recurrence
// frac(1/2 + n (1/g, 1/g^2)) with the plastic number g, an endless sequence in two dimensions.
#pragma once

#include <cmath>
#include <cstdint>

#include "lightproof/points/additive_recurrence.h"
#include "lightproof/points/point_set.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// 1/2 in units of 2^-32, where R2 starts.
inline constexpr std::uint32_t kR2Start = 0x80000000U;

/// Roberts' R2 sequence in fixed point of 32 bits. The second step is even, so that t repeats after
/// 2^31 points; the pair does not.
class R2 {
 public:
  explicit R2(PointSeed seed)
      : s_{nearest_step(kPlastic), kR2Start + shift_of(seed).s},
        t_{nearest_step(kPlasticSquared), kR2Start + shift_of(seed).t} {}

  SquarePoint point(std::uint32_t index) const {
    return {from_fixed_point(s_.at(index)), from_fixed_point(t_.at(index))};
  }

 private:
  AdditiveRecurrence s_;
  AdditiveRecurrence t_;
};

/// fract(offset + alpha n) in float, as shaders have it: the larger n, the fewer bits are
/// left behind the point.
class R2Float {
 public:
  explicit R2Float(PointSeed seed)
      : start_{(kR2Start + shift_of(seed).s) & ~0xffU, (kR2Start + shift_of(seed).t) & ~0xffU},
        offset_s_(static_cast<float>(from_top_24_bits(start_.s))),
        offset_t_(static_cast<float>(from_top_24_bits(start_.t))) {}

  SquarePoint point(std::uint32_t index) const {
    const auto n = static_cast<float>(index);
    return {fract(offset_s_ + kFactorS * n), fract(offset_t_ + kFactorT * n)};
  }
  SquarePoint exact_point(std::uint32_t index) const {
    return {exact_fraction(kPlastic, start_.s, index),
            exact_fraction(kPlasticSquared, start_.t, index)};
  }

 private:
  static constexpr auto kFactorS = static_cast<float>(kPlastic.value());
  static constexpr auto kFactorT = static_cast<float>(kPlasticSquared.value());

  WordPair start_;
  float offset_s_;
  float offset_t_;
};

}  // namespace lightproof
