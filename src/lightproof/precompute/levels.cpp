#include "lightproof/precompute/levels.h"

#include <algorithm>

#include "lightproof/image/lat_long_texels.h"
#include "lightproof/prefilter/irradiance_map.h"

namespace lightproof {
namespace {

bool is_exact_irradiance(const PrecomputeRequest& request, const LevelPlan& plan) {
  return plan.product == Product::irradiance && request.method.method == PrefilterMethod::fast;
}

MapLevel level_of(const LevelPlan& plan, std::span<const Rgb> values) {
  MapLevel level{plan.roughness, {}};
  for (std::size_t first = 0; first < values.size(); first += plan.extent.count()) {
    Grid<Rgb>& face = level.faces.emplace_back(plan.extent);
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), plan.extent.count(),
                face.values().begin());
  }
  return level;
}

std::vector<MapLevel> lat_long_levels(const EnvironmentMap& map, const PrecomputeRequest& request,
                                      std::span<const LevelPlan> plans) {
  std::vector<MapLevel> levels;
  if (is_exact_irradiance(request, plans.front())) {
    for (const LevelPlan& plan : plans) {
      levels.push_back(
          lat_long_level(rounded(diffuse_map(irradiance_map(map, plan.extent)).radiance)));
    }
    return levels;
  }
  std::vector<PrefilteredLevel> wanted;
  for (const LevelPlan& plan : plans) wanted.push_back({plan.lobe, plan.extent});
  const std::vector<Grid<Rgb>> made = prefilter(map.radiance, wanted, request.method);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    levels.push_back(lat_long_level(made[i], plans[i].roughness));
  }
  return levels;
}

MapLevel cube_level(const EnvironmentMap& map, const PrecomputeRequest& request,
                    const LevelPlan& plan) {
  const std::vector<Direction> directions = texel_directions(request.projection, plan.extent);
  if (!is_exact_irradiance(request, plan)) {
    return level_of(plan, prefilter(map.radiance, plan.lobe, directions, request.method));
  }
  std::vector<Rgb> values;
  for (const Irradiance& irradiance : irradiances(map, directions)) {
    values.emplace_back(reflected_by_white(irradiance).rgb);
  }
  return level_of(plan, values);
}

}  // namespace

std::vector<std::vector<LevelPlan>> work_units(const PrecomputeRequest& request) {
  std::vector<std::vector<LevelPlan>> units;
  // The transform of the map into harmonics is shared by all levels.
  const bool together = !is_cube(request.projection) &&
                        (request.method.method == PrefilterMethod::fast ||
                         request.method.method == PrefilterMethod::spherical_harmonics);
  for (const ProductRequest& product : request.products) {
    if (product.product == Product::brdf_map) continue;
    const std::vector<LevelPlan> plans = plan_levels(product, request.projection);
    if (together) {
      units.push_back(plans);
    } else {
      for (const LevelPlan& plan : plans) units.push_back({plan});
    }
  }
  return units;
}

std::vector<MapLevel> make_levels(const EnvironmentMap& map, const PrecomputeRequest& request,
                                  std::span<const LevelPlan> plans) {
  require_lat_long(map, "a map for real-time rendering");
  if (!is_cube(request.projection)) return lat_long_levels(map, request, plans);
  std::vector<MapLevel> levels;
  for (const LevelPlan& plan : plans) levels.push_back(cube_level(map, request, plan));
  return levels;
}

std::vector<Direction> texel_directions(Projection projection, Extent extent) {
  std::vector<Direction> directions;
  for (int face = 0; face < info(projection).faces; ++face) {
    for (int row = 0; row < extent.height; ++row) {
      for (int column = 0; column < extent.width; ++column) {
        directions.push_back(direction_of(projection, extent, {face, column, row}));
      }
    }
  }
  return directions;
}

}  // namespace lightproof
