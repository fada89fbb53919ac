// Every outcome of a small multinomial distribution.
#pragma once

#include <cstdint>
#include <vector>

namespace lightproof {

/// Calls visit(counts) for every way to put `samples` into the cells from `first` on.
template <class Visitor>
void for_all_counts(std::vector<std::uint64_t>& counts, std::size_t first, std::uint64_t samples,
                    const Visitor& visit) {
  if (first + 1 == counts.size()) {
    counts[first] = samples;
    visit(counts);
    return;
  }
  for (std::uint64_t n = 0; n <= samples; ++n) {
    counts[first] = n;
    for_all_counts(counts, first + 1, samples - n, visit);
  }
}

}  // namespace lightproof
