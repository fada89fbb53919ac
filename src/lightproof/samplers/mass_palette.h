// Few different masses in place of many, so that a short code names a cell's mass. The brightest
// cells have masses of their own; the others are rounded to some binary digits, up and down by
// turns, so that no stretch of cells gains.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/large_pages.h"

namespace lightproof {

/// Masses of which at most 2^bits are different.
struct MassPalette {
  std::vector<std::uint64_t> masses;
  TableVector<std::uint16_t> codes;  ///< of every cell, indices of `masses`

  /// Rounds the masses of cells where they are; their sum stays what it was, and what is positive
  /// stays so. 11 to 16 bits; fewer only if there are no more cells than codes. In parallel, the
  /// same for any number of threads.
  MassPalette(std::span<std::uint64_t> cells, unsigned bits);
};

}  // namespace lightproof
