// Inversion by bisection: O(log W + log H) per sample, texel for texel the same as LinearScan.
#pragma once

#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// Halves the range. Which half is chosen by arithmetic, not by a branch: the outcome is random, so
/// a processor would mispredict every second one. What a guessed branch would have read ahead is
/// prefetched instead, for both outcomes.
inline int search_by_bisection(CdfKnots knots, std::uint32_t u) {
  const std::uint32_t* cell = knots.data();
  for (std::size_t cells = knots.size() - 1; cells > 1;) {
    const std::size_t half = cells / 2;
    __builtin_prefetch(cell + half / 2);
    __builtin_prefetch(cell + half + half / 2);
    cell += cell[half] <= u ? half : 0;
    cells -= half;
  }
  return static_cast<int>(cell - knots.data());
}

using BinarySearch = CdfInversion<SortedKnots<search_by_bisection>>;
static_assert(EnvSampler<BinarySearch>);

}  // namespace lightproof
