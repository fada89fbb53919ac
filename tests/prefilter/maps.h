// Maps and normals that try what is computed of them.
#pragma once

#include <algorithm>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

/// Every texel its own colour in [0, 1); the same in every run.
inline EnvironmentMap random_map(Extent extent) {
  EnvironmentMap map{"random", Grid<Rgb>(extent), {}};
  const RandomStream stream("prefilter/map", 1);
  for (std::size_t i = 0; i < extent.count(); ++i) {
    const SquarePoint a = stream.point(2 * i);
    map.radiance.values()[i] = Rgb(a.s, a.t, stream.point(2 * i + 1).s);
  }
  return map;
}

/// The same with a sun of one texel.
inline EnvironmentMap random_map_with_sun(Extent extent) {
  EnvironmentMap map = random_map(extent);
  map.radiance(extent.width / 3, extent.height * 2 / 3) = Rgb(1e5F, 8e4F, 5e4F);
  return map;
}

/// Black but for one texel of this radiance.
inline EnvironmentMap one_lit_texel(Extent extent, int x, int y, float radiance = 1.0F) {
  EnvironmentMap map{"one lit texel", Grid<Rgb>(extent), {}};
  map.radiance(x, y) = Rgb(radiance);
  return map;
}

/// The sum of all texels in the brightest channel: rounding errors are in proportion to it.
inline double sum_of_texels(const EnvironmentMap& map) {
  glm::dvec3 sum(0.0);
  for (const Rgb texel : map.radiance.values()) sum += glm::dvec3(texel);
  return std::max({sum.r, sum.g, sum.b});
}

/// Both poles, the horizon along and between the edges of columns, the neighbourhood of all these,
/// and directions without symmetry.
inline std::vector<Direction> trying_normals() {
  std::vector<Direction> normals = {{0, 0, 1},        {0, 0, -1},         {1, 0, 0},  {-1, 0, 0},
                                    {0, 1, 0},        {0, -1, 0},         {1, 1, 0},  {1, 0, 1e-9},
                                    {1e-9, 0, 1},     {-1e-9, 1e-12, -1}, {1, 2, -3}, {-3, 1, 0.5},
                                    {-1, 1e-13, 0.3}, {-1, -1e-13, -0.3}};
  const RandomStream stream("prefilter/normals", 1);
  for (std::uint64_t i = 0; i < 6; ++i) {
    const SquarePoint u = stream.point(i);
    normals.push_back(direction_from_square(u));
  }
  for (Direction& normal : normals) normal = glm::normalize(normal);
  return normals;
}

/// Sizes of maps: one texel, one row, one column, odd numbers, texels that are not square.
inline constexpr Extent kTryingExtents[] = {{1, 1}, {2, 1}, {1, 2},  {3, 2},  {1, 5},
                                            {5, 3}, {8, 4}, {7, 12}, {33, 17}};

}  // namespace lightproof
