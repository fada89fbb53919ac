// A single part: directions of points of a map.
#include <cmath>
#include <cstdio>

#include "lightproof/warp/lat_long.h"

int main() {
  const lightproof::Direction forward = lightproof::direction_from_square({0.5, 0.5});
  std::printf("length %.3f\n", glm::length(forward));
  return std::abs(glm::length(forward) - 1.0) < 1e-6 ? 0 : 1;
}
