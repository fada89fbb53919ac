// The lattice (n/N, frac(n alpha)) of a metallic number: of all alpha the golden ratio's is the
// hardest to approximate by fractions, and leaves the least gaps (Roberts 2018).
#pragma once

#include <cmath>
#include <cstdint>

#include "lightproof/points/additive_recurrence.h"
#include "lightproof/points/point_set.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/rank_coordinate.h"
#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// In fixed point, with alpha as a step of 2^-32. The seed shifts, as the offset of a pixel does.
class MetallicLattice {
 public:
  /// The count N is in [1, 2^32].
  MetallicLattice(std::uint32_t step, std::uint64_t count, PointSeed seed)
      : rank_(count, shift_of(seed).s), recurrence_{step, shift_of(seed).t} {}

  SquarePoint point(std::uint32_t index) const {
    return {rank_.at(index), from_fixed_point(recurrence_.at(index))};
  }

 private:
  RankCoordinate rank_;
  AdditiveRecurrence recurrence_;
};

/// fract(offset + alpha n) in float, as one multiplication writes it in a shader: the larger n, the
/// fewer bits are left behind the point, none from 2^23 / alpha on.
class MetallicLatticeFloat {
 public:
  /// The count N is in [1, 2^32].
  MetallicLatticeFloat(Alpha alpha, std::uint64_t count, PointSeed seed)
      : alpha_(alpha),
        rank_(count, shift_of(seed).s),
        start_(shift_of(seed).t & ~0xffU),
        factor_(static_cast<float>(alpha.value())),
        offset_(static_cast<float>(from_top_24_bits(start_))) {}

  SquarePoint point(std::uint32_t index) const {
    return {rank_.at(index), fract(offset_ + factor_ * static_cast<float>(index))};
  }
  SquarePoint exact_point(std::uint32_t index) const {
    return {rank_.at(index), exact_fraction(alpha_, start_, index)};
  }

 private:
  Alpha alpha_;
  RankCoordinate rank_;
  std::uint32_t start_;
  float factor_;
  float offset_;
};

}  // namespace lightproof
