// A map at half, a quarter, … of its size, for look-ups of a footprint.
#pragma once

#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof {

class MipPyramid {
 public:
  /// Level 0 is the map itself, which must outlive the pyramid; every further one has half the
  /// width and height, rounded down, until there is one texel.
  explicit MipPyramid(const Grid<Rgb>& map);

  /// Interpolated bilinearly in the two levels beside `level`, and linearly between them.
  glm::dvec3 trilinear(SquarePoint at, double level) const;

  const Grid<Rgb>& base() const { return *base_; }

 private:
  const Grid<Rgb>& level(std::size_t index) const {
    return index == 0 ? *base_ : smaller_[index - 1];
  }

  const Grid<Rgb>* base_;
  std::vector<Grid<Rgb>> smaller_;
};

}  // namespace lightproof
