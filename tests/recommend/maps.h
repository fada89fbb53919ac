// Maps for the tests of predictions.
#pragma once

#include <cmath>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A map of independent values spread evenly over so many powers of ten.
inline EnvironmentMap random_map(Extent extent, double decades) {
  EnvironmentMap map{"random", Grid<Rgb>(extent)};
  const RandomStream stream("recommend/map", 1);
  std::uint64_t index = 0;
  for (Rgb& texel : map.radiance.values()) {
    texel = Rgb(static_cast<float>(std::pow(10.0, decades * stream.point(index++).s)));
  }
  return map;
}

}  // namespace lightproof
