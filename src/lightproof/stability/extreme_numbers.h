// Every random number that a float can be: all multiples of 2^-24 below 1, and the ends.
#pragma once

#include <cstdint>

#include "lightproof/stability/sampler_on_map.h"

namespace lightproof {

/// Which coordinate of the random point runs through all numbers; the other one stays.
enum class Coordinate { s, t };

/// Which of the 2^24 numbers k 2^-24 are taken: k = first, first + stride, …
struct FloatNumbers {
  std::uint32_t first = 0;
  std::uint32_t stride = 1;
};

/// Draws at every number of one coordinate, and at 1 - 2^-53 and 1 (check_drawn()).
Finding check_every_float(const SamplerOnMap& on_map, Coordinate coordinate, double other,
                          FloatNumbers numbers);

/// Whether, in a sampler that inverts rows by t, then columns by s, each column of a row, or each
/// row, gets as many of the numbers as its declared probability says, to within one number at
/// either end, what the sampler declares of its rounding, and floats. The amount is the largest
/// difference in numbers.
Finding check_counts(const SamplerOnMap& on_map, Coordinate coordinate, double other,
                     FloatNumbers numbers);

}  // namespace lightproof
