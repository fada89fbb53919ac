// Independent uniform points by Philox4x32-10, of which all random numbers of Lightproof come.
#pragma once

#include <cstdint>

#include "lightproof/core/random.h"
#include "lightproof/points/point_set.h"

namespace lightproof {

class PhiloxPoints {
 public:
  explicit PhiloxPoints(PointSeed seed) : stream_("points/philox", seed.value_or(0)) {}
  SquarePoint point(std::uint32_t index) const { return stream_.point(index); }

 private:
  RandomStream stream_;
};

}  // namespace lightproof
