#include "lightproof/samplers/texel_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/samplers/weight_vectors.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target) {
  const Extent extent = map.radiance.extent();
  Grid<double> weights = Grid<double>::without_values(extent);
  std::vector<char> has_light(static_cast<std::size_t>(extent.height));
  parallel_for(has_light.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    weigh_row(map, target, y, weights.row(y));
    has_light[row] = std::ranges::any_of(weights.row(y), [](double w) { return w > 0.0; }) ? 1 : 0;
  });
  if (std::ranges::find(has_light, 1) == has_light.end()) refuse_black(map);
  return weights;
}

void weigh_row(const EnvironmentMap& map, TargetDensity target, int y, std::span<double> weights) {
  const Extent extent = map.radiance.extent();
  const double area = target.weighting == Weighting::B ? texel_solid_angle(extent, y) : 1.0;
  weigh(map.radiance.row(y), target.grey, area, weights);
}

void refuse_black(const EnvironmentMap& map) {
  throw InputError(fmt::format("{}: the map is black: there is no light to sample", map.name));
}

}  // namespace lightproof
