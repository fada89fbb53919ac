// The limit: random numbers, and one number of two bytes a texel read at random. Whatever draws
// from a table of that size does at least this.
#pragma once

#include <cstdint>

#include "lightproof/core/grid.h"
#include "lightproof/core/huge_pages.h"
#include "lightproof/core/random.h"

namespace lightproof::bench {

class BareGather {
 public:
  explicit BareGather(Extent extent);

  /// Sum of the numbers at the points first, first + 1, … of the stream; nothing else is written.
  std::uint64_t read(const RandomStream& stream, std::uint64_t first, std::size_t count) const;

  /// Sum of the numbers at the points first, first + 1, … of the stream, and of one reciprocal
  /// square root, one sine and one cosine a point: what any sampler of directions has to compute.
  /// Nothing else is written.
  double read_directions(const RandomStream& stream, std::uint64_t first, std::size_t count) const;

  std::size_t table_bytes() const { return numbers_.size() * sizeof(std::uint16_t); }

 private:
  std::size_t texels_;
  TableVector<std::uint16_t> numbers_;
};

}  // namespace lightproof::bench
