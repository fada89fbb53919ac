#include "lightproof/study/warp_grids.h"

#include <algorithm>
#include <cmath>

#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// A prime number: steps of a grid that divide the map's texels evenly would fall on one column.
constexpr int kSide = 31;

double degrees_between(SquarePoint a, SquarePoint b) {
  const double cosine = glm::dot(direction_from_square(a), direction_from_square(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / kPi;
}

/// Over all pairs side by side in a row or in a column.
double mean_neighbour_degrees(const WarpGrid& grid) {
  double sum = 0.0;
  int pairs = 0;
  const auto at = [&](int x, int y) {
    return grid.points[static_cast<std::size_t>(y * grid.side + x)];
  };
  for (int i = 0; i < grid.side; ++i) {
    for (int k = 1; k < grid.side; ++k) {
      sum += degrees_between(at(k - 1, i), at(k, i)) + degrees_between(at(i, k - 1), at(i, k));
      pairs += 2;
    }
  }
  return sum / pairs;
}

template <class Sampler>
WarpGrid grid_through(const Sampler& sampler, const EnvironmentMap& map, const char* name,
                      bool is_monotone) {
  WarpGrid grid{map.name, name, is_monotone, kSide, {}, 0.0};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      grid.points.push_back(sampler.sample({(x + 0.5) / kSide, (y + 0.5) / kSide}).at);
    }
  }
  grid.neighbour_degrees = mean_neighbour_degrees(grid);
  return grid;
}

}  // namespace

std::vector<WarpGrid> study_warp_grids(std::span<const EnvironmentMap> maps) {
  std::vector<WarpGrid> grids;
  for (const EnvironmentMap& map : maps) {
    const TargetDensity target = on_map({DensitySpace::solid_angle}, map);
    grids.push_back(grid_through(BinarySearch(map, target), map, "binary_search", true));
    grids.push_back(grid_through(Alias(map, target), map, "alias", false));
  }
  return grids;
}

}  // namespace lightproof
