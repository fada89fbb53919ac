#include "lightproof/image/map_figures.h"

#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

MapFigures figures_of(const EnvironmentMap& map) {
  MapFigures figures;
  double first = 0.0;
  double second = 0.0;
  const Extent extent = map.radiance.extent();
  const bool has_rows = rows_are_parallels(map.mapping);
  for (int y = 0; y < extent.height; ++y) {
    throw_if_interrupted();
    const double of_row = texel_solid_angle(map.mapping, extent, 0, y);
    for (int x = 0; x < extent.width; ++x) {
      const double solid_angle = has_rows ? of_row : texel_solid_angle(map.mapping, extent, x, y);
      const double luminance = luminance_of(map.radiance(x, y), map.weights);
      first += luminance * solid_angle;
      second += luminance * luminance * solid_angle;
      if (luminance <= figures.peak_luminance) continue;
      figures.peak_luminance = luminance;
      figures.peak_column = x;
      figures.peak_row = y;
    }
  }
  figures.mean_luminance = first / kSphere;
  figures.effective_fraction = first * first / (kSphere * second);
  return figures;
}

Direction direction_of_texel(Extent map, int column, int row, const Mapping& mapping) {
  return direction_at(mapping, {(column + 0.5) / map.width, (row + 0.5) / map.height});
}

}  // namespace lightproof
