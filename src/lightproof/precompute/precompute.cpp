#include "lightproof/precompute/precompute.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "lightproof/core/random.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/precompute/level_check.h"
#include "lightproof/precompute/levels.h"

namespace lightproof {
namespace {

std::string_view method_name(PrefilterMethod method) {
  const auto infos = prefilter_methods();
  return std::find_if(infos.begin(), infos.end(),
                      [&](const PrefilterMethodInfo& info) { return info.method == method; })
      ->name;
}

bool draws_samples(PrefilterMethod method) {
  return method != PrefilterMethod::fast && method != PrefilterMethod::spherical_harmonics;
}

Attributes attributes_of(const EnvironmentMap& map, const PrecomputeRequest& request,
                         Product product) {
  const auto description =
      std::find_if(products().begin(), products().end(), [&](const ProductInfo& i) {
        return i.product == product;
      })->description;
  Attributes attributes = {
      {"product", fmt::format("{}: {}", name_of(product), description)},
      {"source", fmt::format("{}, {}x{}", map.source.empty() ? map.name : map.source,
                             map.radiance.extent().width, map.radiance.extent().height)},
      {"method", std::string(method_name(request.method.method))}};
  if (draws_samples(request.method.method)) {
    attributes.push_back({"samples", fmt::format("{} a texel", request.method.samples)});
  }
  if (request.method.method == PrefilterMethod::spherical_harmonics) {
    attributes.push_back({"degree", fmt::format("up to {}", request.method.degree)});
  }
  return attributes;
}

/// "specular-3", or "specular" if all levels are made together.
std::string name_of_unit(std::span<const LevelPlan> unit) {
  const std::string product(name_of(unit.front().product));
  return unit.size() > 1 ? product : fmt::format("{}-{}", product, unit.front().level);
}

PrecomputedBrdfMap make_brdf_map(const PrecomputeRequest& request, const ProductRequest& product,
                                 const UnfinishedWork& unfinished, const CheckOptions& check) {
  const Extent extent =
      product.extent.value_or(default_extent(Product::brdf_map, request.projection));
  PrecomputedBrdfMap made{std::string(name_of(Product::brdf_map)), {}};
  const std::string name =
      fmt::format("brdf-map-{}x{}-{}", extent.width, extent.height, name_of(request.masking));
  made.map.values = unfinished.stage<Grid<glm::vec2>>(name, [&](const Communicator& /*alone*/) {
    Grid<glm::vec2> pairs(extent);
    const Grid<ScaleBias> values = brdf_map(extent, request.masking);
    for (std::size_t i = 0; i < extent.count(); ++i) {
      pairs.values()[i] = {values.values()[i].scale, values.values()[i].bias};
    }
    return pairs;
  });
  made.map.attributes = {{"product", "brdf-map: scale and bias of the split sum"},
                         {"method", "quadrature"},
                         {"masking", std::string(name_of(request.masking))}};
  if (check.texels > 0) {
    made.error = check_brdf_map(made.map, request.masking,
                                RandomStream("check/brdf-map", check.seed), check.texels);
  }
  return made;
}

/// Where the work is, as a fraction of all texels.
class Work {
 public:
  Work(std::span<const std::vector<LevelPlan>> units, const Progress& progress)
      : progress_(progress) {
    for (const auto& unit : units) {
      for (const LevelPlan& plan : unit) whole_ += static_cast<double>(plan.extent.count());
    }
  }
  void show(std::string_view step) const {
    if (progress_) progress_(step, done_ / whole_);
  }
  void add(const LevelPlan& plan) { done_ += static_cast<double>(plan.extent.count()); }

 private:
  const Progress& progress_;
  double whole_ = 0.0;
  double done_ = 0.0;
};

std::vector<MapLevel> levels_of(const EnvironmentMap& map, const PrecomputeRequest& request,
                                std::span<const LevelPlan> unit, const UnfinishedWork& unfinished) {
  return unfinished.stage<std::vector<MapLevel>>(
      name_of_unit(unit),
      [&](const Communicator& /*alone*/) { return make_levels(map, request, unit); });
}

void check_levels(const EnvironmentMap& map, Projection projection,
                  std::span<const LevelPlan> plans, const CheckOptions& check,
                  const Progress& progress, PrecomputedMap& made) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (progress) progress("check", static_cast<double>(i) / static_cast<double>(plans.size()));
    const RandomStream stream(fmt::format("check/{}/{}", made.name, plans[i].level), check.seed);
    made.errors.emplace_back(
        check_level(map, projection, plans[i], made.map.levels[i], stream, check.texels));
  }
}

}  // namespace

Precomputation precompute(const EnvironmentMap& map, const PrecomputeRequest& request,
                          const UnfinishedWork& unfinished, const CheckOptions& check,
                          const Progress& progress) {
  require_lat_long(map, "a map for real-time rendering");
  Precomputation result{map.source.empty() ? map.name : map.source, {}};
  if (check.texels > 0) result.error_measure = error_measure();
  const std::vector<std::vector<LevelPlan>> units = work_units(request);
  Work work(units, progress);
  for (const std::vector<LevelPlan>& unit : units) {
    const std::string name(name_of(unit.front().product));
    work.show("precompute");
    if (result.maps.empty() || result.maps.back().name != name) {
      result.maps.push_back({name, {request.projection, {}}});
      result.maps.back().map.attributes = attributes_of(map, request, unit.front().product);
    }
    std::vector<MapLevel>& levels = result.maps.back().map.levels;
    for (MapLevel& level : levels_of(map, request, unit, unfinished)) {
      levels.push_back(std::move(level));
    }
    for (const LevelPlan& plan : unit) work.add(plan);
  }
  for (const ProductRequest& product : request.products) {
    if (product.product == Product::brdf_map) {
      result.brdf_map = make_brdf_map(request, product, unfinished, check);
      continue;
    }
    const auto made =
        std::find_if(result.maps.begin(), result.maps.end(),
                     [&](const PrecomputedMap& m) { return m.name == name_of(product.product); });
    if (check.texels == 0) continue;
    check_levels(map, request.projection, plan_levels(product, request.projection), check, progress,
                 *made);
  }
  return result;
}

std::optional<double> largest_error(const Precomputation& made) {
  std::optional<double> largest;
  const auto add = [&](const std::optional<LevelError>& error) {
    if (error) largest = std::max(largest.value_or(0.0), error->error);
  };
  for (const PrecomputedMap& map : made.maps) {
    for (const std::optional<LevelError>& error : map.errors) add(error);
  }
  if (made.brdf_map) add(made.brdf_map->error);
  return largest;
}

}  // namespace lightproof
