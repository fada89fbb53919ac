// The lecture's linear scan without its defects: it stops at the first texel whose cumulative mass
// lies *above* the random number, never at one without mass, over stored sums.
// O(W + H) per sample.
#pragma once

#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// The index of the cell that u lies in, by a walk from the first cell on.
inline int search_by_scan(CdfEntries entries, std::uint32_t u) {
  std::size_t cell = 0;
  while (entries[cell + 1] <= u) ++cell;
  return static_cast<int>(cell);
}

using LinearScan = CdfInversion<SortedEntries<search_by_scan>>;
static_assert(EnvSampler<LinearScan>);

}  // namespace lightproof
