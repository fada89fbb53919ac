// Loops over weights that every table is built with, vectorised (Highway): the same bits for every
// kind of vector. Each tells how many numbers vectors did, from the front: 0 on a processor without
// vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// What is known of weights that were computed.
struct Weighed {
  std::size_t by_vectors;  ///< how many vectors computed, from the front
  bool are_possible;       ///< whether all are finite and none is negative
};

/// Writes weights[i] = area * luminance(texels[i], luminance). There may be more texels than
/// weights: those that come later in memory and are asked for ahead.
Weighed weigh(std::span<const Rgb> texels, LuminanceWeights luminance, double area,
              std::span<double> weights);

/// Sums of weights >= 0, which run side by side in a fixed order: weight i is added to the sum
/// i % kLanes.
class WeightSums {
 public:
  WeightSums();
  explicit WeightSums(std::span<const double> weights) : WeightSums() { add(weights); }

  /// Adds weights; all additions but the last must be of a multiple of kLanes. Returns how many of
  /// them vectors added.
  std::size_t add(std::span<const double> weights);

  /// The sum of all weights.
  double sum() const;
  /// How many weights are positive.
  std::size_t positive() const;
  /// The least positive weight; infinite if none is positive.
  double least_positive() const;

  static constexpr std::size_t kLanes = 8;
  struct Lanes {
    std::array<double, kLanes> sum;
    std::array<double, kLanes> least_positive;
    std::array<std::int64_t, kLanes> positive;
  };

 private:
  Lanes lanes_;
};

/// How weights become whole numbers.
struct FixedPoint {
  double scale;        ///< what weights are multiplied by
  std::int64_t least;  ///< what a positive weight gives at least
  std::int64_t more;   ///< what a positive weight gives besides
};

/// Writes fixed[i] = scale * weights[i], rounded to the nearest whole number, of two the higher,
/// below 2^62; at least `least`, and `more` beside it, if the weight is positive. Both spans are of
/// one size. Returns how many of them vectors did.
std::size_t to_fixed_point(std::span<const double> weights, const FixedPoint& form,
                           std::span<std::int64_t> fixed);

/// What whole numbers lack of another, in sum, and what they have above it.
struct Balance {
  std::uint64_t lack;
  std::uint64_t excess;

  /// Adds what further numbers, all below 2^62, lack of `full` and have above it; both sums stay
  /// below 2^64. Returns how many of the numbers vectors added.
  std::size_t add(std::span<const std::uint64_t> numbers, std::uint64_t full);
};

/// What numbers below 2^62 lack of `full`, in sum, and what they have above it; both sums stay
/// below 2^64.
Balance balance_of(std::span<const std::uint64_t> numbers, std::uint64_t full);

}  // namespace lightproof
