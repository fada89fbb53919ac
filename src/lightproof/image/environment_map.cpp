#include "lightproof/image/environment_map.h"

#include <algorithm>

#include "lightproof/core/parallel.h"

namespace lightproof {

Grid<double> luminance_of(const EnvironmentMap& map) { return luminance_of(map, map.weights); }

Grid<double> luminance_of(const EnvironmentMap& map, LuminanceWeights weights) {
  const Extent extent = map.radiance.extent();
  Grid<double> luminance(extent);
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::ranges::transform(map.radiance.row(y), luminance.row(y).begin(),
                           [&](Rgb rgb) { return luminance_of(rgb, weights); });
  });
  return luminance;
}

}  // namespace lightproof
