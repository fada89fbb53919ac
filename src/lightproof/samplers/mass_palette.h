// Few different masses in place of many, so that a short code names a cell's mass. The brightest
// cells have masses of their own; the others are rounded to some binary digits, up and down by
// turns, so that no stretch of cells gains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightproof/core/huge_pages.h"

namespace lightproof {

/// Cells' masses, of which at most 2^bits are different.
struct MassPalette {
  TableVector<std::uint64_t> cells;   ///< the rounded mass of every cell
  std::vector<std::uint64_t> masses;  ///< the different ones among them
  TableVector<std::uint16_t> codes;   ///< for every cell the index of its mass in `masses`

  /// Rounds these masses; their sum, below 2^64, stays what it was, and what is positive stays so.
  /// 11 to 16 bits; fewer only if there are no more cells than codes. The result is the same for
  /// any number of threads.
  MassPalette(TableVector<std::uint64_t> exact, unsigned bits);

 private:
  void keep_all();
  void round_all(std::size_t most);
  /// Adds a mass to the palette and returns its code.
  std::uint16_t add(std::uint64_t mass);
};

}  // namespace lightproof
