#include "lightproof/estimators/registry.h"

#include <algorithm>
#include <array>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/estimators/one_sample.h"

namespace lightproof {
namespace {

using reference::SampledDensity;

constexpr std::array kEstimators = {
    EstimatorInfo{
        .name = "uniform",
        .description = "uniform over the sphere, density 1/4pi",
        .source = "Kajiya 1986",
        .density = SampledDensity::uniform,
        .prepare =
            [](const EnvironmentMap& map) { return prepare_one_sample(map, UniformSphere{}); }},
    EstimatorInfo{
        .name = "brdf",
        .description = "the material's own lobes",
        .source = "Lafortune and Willems 1994",
        .density = SampledDensity::material,
        .prepare =
            [](const EnvironmentMap& map) { return prepare_one_sample(map, MaterialLobes{}); }},
    EstimatorInfo{.name = "environment A",
                  .description = "the map, density over (s,t) proportional to luminance",
                  .source = "the lecture: weights 2 pi^2 sin(theta) / p(s,t)",
                  .density = SampledDensity::texture_space,
                  .prepare =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::texture});
                      }},
    EstimatorInfo{.name = "environment B",
                  .description = "the map, density over directions proportional to luminance",
                  .source = "Pharr, Jakob and Humphreys, Physically Based Rendering, 12.5",
                  .density = SampledDensity::solid_angle,
                  .prepare =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::solid_angle});
                      }},
};

}  // namespace

std::span<const EstimatorInfo> estimators() { return kEstimators; }

const EstimatorInfo& estimator_by_name(std::string_view name) {
  const auto found = std::find_if(kEstimators.begin(), kEstimators.end(),
                                  [&](const EstimatorInfo& row) { return row.name == name; });
  if (found != kEstimators.end()) return *found;
  std::string names;
  for (const EstimatorInfo& row : kEstimators) {
    names.append(names.empty() ? "" : ", ").append(row.name);
  }
  throw InputError("there is no estimator \"" + std::string(name) + "\": there are " + names);
}

}  // namespace lightproof
