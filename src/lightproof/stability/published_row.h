// The float sums of the published scan over one row of texels, and exactly what they do to random
// numbers: which texels are out of reach, how many samples land elsewhere. No sample is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lightproof {

/// One row as the lecture's listing scans it: sums of probability / count in float, in order, until
/// one reaches the random number, of which a shader has 24 bits.
class PublishedRow {
 public:
  explicit PublishedRow(std::vector<float> weights);

  int count() const { return static_cast<int>(sums_.size()); }
  /// The sum up to and including each texel.
  std::span<const float> sums() const { return sums_; }

  struct Stop {
    int index;       ///< the texel; count() if no sum reaches the number
    float fraction;  ///< how far the number lies between the sums around it
  };
  /// Where the scan stops at k 2^-24.
  Stop stop(std::uint32_t k) const;
  /// The coordinate that the listing returns, (index + fraction) / count in float.
  float position(std::uint32_t k) const;

  /// The largest difference between a sum and the exact one.
  double largest_error() const;
  /// The share of random numbers, as real numbers of [0,1], whose texel is not the exact one.
  double misplaced() const;
  /// How many texels some k 2^-24 leads to, k from `first` to `last`, at most 2^24.
  int reachable(std::uint32_t first = 0, std::uint32_t last = (1U << 24U) - 1) const;
  /// How far the last sum lies below 1: the probability to fall off the end; 0 if it does not.
  double falls_off() const;
  /// The share of all k 2^-24 that are led to a texel, but to a position in another one.
  double lands_in_neighbour() const;
  /// Whether some of these random numbers falls off the end: 1 - 2^-24 does, if any.
  bool misses_last_number() const;

 private:
  std::vector<float> weights_;
  std::vector<float> sums_;
  std::vector<double> exact_;  ///< the exact sums
};

/// The share of texels that a prefix sum in float over all texels of a constant map of N x N/2
/// never reaches: entries that are equal to the one before.
double unreachable_by_flat_sum(int width);

}  // namespace lightproof
