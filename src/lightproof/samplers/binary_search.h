// Inversion by bisection: O(log W + log H) per sample, texel for texel the same as LinearScan.
#pragma once

#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// The index of the cell that u lies in, by halving the range. Which half is chosen by arithmetic,
/// not by a branch: the outcome is random, so a processor would mispredict every second one. What a
/// guessed branch would have read ahead is prefetched instead, for both outcomes.
inline int search_by_bisection(CdfEntries entries, std::uint32_t u) {
  const std::uint32_t* cell = entries.data();
  for (std::size_t cells = entries.size() - 1; cells > 1;) {
    const std::size_t half = cells / 2;
    __builtin_prefetch(cell + half / 2);
    __builtin_prefetch(cell + half + half / 2);
    cell += cell[half] <= u ? half : 0;
    cells -= half;
  }
  return static_cast<int>(cell - entries.data());
}

/// The CDF entries of a table, searched by bisection.
class BisectedEntries : public SortedEntries<search_by_bisection> {
 public:
  using SortedEntries::SortedEntries;
  struct View {};  ///< all that is needed is the table
  View view() const { return {}; }
};

using BinarySearch = CdfInversion<BisectedEntries>;
using BinarySearchView = CdfInversionView<BisectedEntries::View>;
static_assert(EnvSampler<BinarySearch>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const BinarySearchView& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
