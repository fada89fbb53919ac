#include "lightproof/estimators/registry.h"

#include <algorithm>
#include <array>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/estimators/one_sample.h"
#include "lightproof/estimators/point_set.h"

namespace lightproof {
namespace {

using reference::SampledDensity;

/// Names of point sets.
constexpr std::string_view kHammersley = "hammersley";
constexpr std::string_view kR2 = "R2";
constexpr std::string_view kSobol = "sobol";

template <const std::string_view& kPointSet>
PreparedEstimator from_map_at(const EnvironmentMap& map) {
  return prepare_point_set(map, MapDensity{DensitySpace::solid_angle}, kPointSet);
}

template <const std::string_view& kPointSet>
PreparedEstimator from_lobes_at(const EnvironmentMap& map) {
  return prepare_point_set(map, MaterialLobes{}, kPointSet);
}

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
    EstimatorInfo{.name = "environment C",
                  .description = "the map, texels in proportion to luminance times solid angle, "
                                 "positions uniform in (s,t)",
                  .source = "pbrt-v3's InfiniteAreaLight, Mitsuba's envmap, Cycles",
                  .density = SampledDensity::sine_weighted,
                  .prepare =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::sine_weighted});
                      }},
    EstimatorInfo{.name = "environment B hammersley",
                  .description = "as environment B, at Hammersley's points, shifted at random",
                  .source = "Hammersley 1960; Cranley and Patterson 1976",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_map_at<kHammersley>},
    EstimatorInfo{.name = "environment B R2",
                  .description = "as environment B, at the points of R2, shifted at random",
                  .source = "Roberts 2018; Cranley and Patterson 1976",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_map_at<kR2>},
    EstimatorInfo{.name = "environment B sobol",
                  .description = "as environment B, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_map_at<kSobol>},
    EstimatorInfo{.name = "brdf hammersley",
                  .description = "as brdf, at Hammersley's points, shifted at random",
                  .source = "Hammersley 1960; Cranley and Patterson 1976",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_lobes_at<kHammersley>},
    EstimatorInfo{.name = "brdf R2",
                  .description = "as brdf, at the points of R2, shifted at random",
                  .source = "Roberts 2018; Cranley and Patterson 1976",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_lobes_at<kR2>},
    EstimatorInfo{.name = "brdf sobol",
                  .description = "as brdf, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .kind = EstimatorKind::point_set,
                  .prepare = from_lobes_at<kSobol>},
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
