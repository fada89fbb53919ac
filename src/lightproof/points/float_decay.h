// How point sets that are computed in float decay: the larger the index, the fewer of its bits, and
// of those behind the point, are left.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lightproof/points/registry.h"

namespace lightproof {

/// What is left of a set over the points first, first + 1, … of a window.
struct FloatDecay {
  std::string_view set;          ///< its name
  std::uint64_t first = 0;       ///< the window's first index
  std::uint64_t window = 0;      ///< its number of points
  double error_s = 0.0;          ///< largest distance to the exact s, on the circle [0,1)
  double error_t = 0.0;          ///< the same of t
  std::uint64_t distinct = 0;    ///< different points
  std::uint64_t distinct_s = 0;  ///< different values of s
  std::uint64_t distinct_t = 0;  ///< different values of t
};

/// One window of an unseeded set of 2^32 points, which ends below 2^32. The exact point is the same
/// formula without rounding: of a hash, that of the whole index. Errors of a set that is not
/// computed in float are 0.
FloatDecay float_decay_at(const PointSetInfo& set, std::uint64_t first, std::uint64_t window);

/// Windows of this size from the indices 0 and 1, 2, 4, … on, as many as end below 2^32, and the
/// last one below it.
std::vector<FloatDecay> float_decay(const PointSetInfo& set, std::uint64_t window = 65536);

}  // namespace lightproof
