#include "lightproof/estimators/environment.h"

#include <algorithm>

#include "lightproof/samplers/alias.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Less of a map's light than this is rounding.
constexpr double kLeastShareLeft = 1e-6;

/// The size of a texel of row y in a measure; of the square that of a sphere whose sine is 1
/// everywhere.
double area_of(MapMeasure measure, Extent extent, int y) {
  return measure == MapMeasure::square ? 2.0 * kPi * kPi / static_cast<double>(extent.count())
                                       : texel_solid_angle(extent, y);
}
/// The size of the whole map in a measure.
double area_of(MapMeasure measure) {
  return measure == MapMeasure::square ? 2.0 * kPi * kPi : kSphere;
}

/// The integral of what stands above a floor, over the areas of texels.
double light_above(const Grid<double>& luminance, MapMeasure measure, double floor) {
  double sum = 0.0;
  for (int y = 0; y < luminance.extent().height; ++y) {
    double row = 0.0;
    for (const double value : luminance.row(y)) row += std::max(0.0, value - floor);
    sum += row * area_of(measure, luminance.extent(), y);
  }
  return sum;
}

/// A grey map of what stands above a floor.
EnvironmentMap map_above(const Grid<double>& luminance, double floor) {
  EnvironmentMap map{"compensated", Grid<Rgb>(luminance.extent())};
  std::ranges::transform(luminance.values(), map.radiance.values().begin(), [floor](double value) {
    return Rgb(static_cast<float>(std::max(0.0, value - floor)));
  });
  map.weights = kAverageLuminance;
  return map;
}

template <class Sampler>
PreparedSource table_source(const EnvironmentMap& map, DensitySpace density_space) {
  const auto table = std::make_shared<const Sampler>(map, on_map({density_space}, map));
  return {&map,
          [table](const Material& material) -> SamplesAt {
            return [table, material](const ShadingPoint& at) -> DrawSamples {
              return [&table = *table, &material, &at](const BatchPoints& points,
                                                       LightSamples& samples) {
                draw_batch(table, points, samples.batch());
                samples.reflect(material, at);
              };
            };
          },
          table->table_bytes()};
}

}  // namespace

EnvironmentTable::EnvironmentTable(const EnvironmentMap& map, DensitySpace density_space,
                                   double compensation)
    : positions_(position_measure(density_space)), weights_(map.weights) {
  const Grid<double> luminance = luminance_of(map);
  const MapMeasure measure = texel_measure(density_space);
  const double whole = light_above(luminance, measure, 0.0);
  if (!(whole > 0.0)) return;
  double left = whole;
  if (compensation > 0.0) {
    const double floor = compensation * whole / area_of(measure);
    const double above = light_above(luminance, measure, floor);
    if (above >= kLeastShareLeft * whole) {
      floor_ = floor;
      left = above;
    }
  }
  for (int y = 0; y < luminance.extent().height; ++y) {
    scales_.push_back(area_of(measure, luminance.extent(), y) /
                      (area_of(positions_, luminance.extent(), y) * left));
  }
  if (floor_ > 0.0) {
    const EnvironmentMap rest = map_above(luminance, floor_);
    table_.emplace(rest, on_map({density_space}, rest));
  } else {
    table_.emplace(map, on_map({density_space}, map));
  }
}

PreparedSource environment_source(const EnvironmentMap& map, DensitySpace density_space) {
  return table_source<GuideTable>(map, density_space);
}

PreparedSource alias_source(const EnvironmentMap& map, DensitySpace density_space) {
  return table_source<Alias>(map, density_space);
}

}  // namespace lightproof
