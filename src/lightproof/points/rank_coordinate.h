// n/N: the coordinate that makes N points of the square out of a sequence in one dimension.
#pragma once

#include <cassert>
#include <cstdint>

#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// frac(n/N + shift), rounded once or twice to double. Distinct for n = 0 … N-1.
class RankCoordinate {
 public:
  /// The count is in [1, 2^32]; the shift in units of 2^-32.
  RankCoordinate(std::uint64_t count, std::uint32_t shift)
      : count_(static_cast<double>(count)), shift_(from_fixed_point(shift)) {}

  /// n is in [0, N]; N gives what 0 does.
  double at(std::uint64_t n) const {
    assert(static_cast<double>(n) <= count_);
    return wrapped(wrapped(static_cast<double>(n) / count_) + shift_);
  }

 private:
  double count_;
  double shift_;
};

}  // namespace lightproof
