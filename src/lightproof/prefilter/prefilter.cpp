#include "lightproof/prefilter/prefilter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/lobe_plan.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/resample.h"
#include "lightproof/prefilter/sampled_prefilter.h"
#include "lightproof/prefilter/sphere_interpolation.h"
#include "lightproof/prefilter/zonal_convolution.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::array kMethods = {
    PrefilterMethodInfo{PrefilterMethod::uniform, "uniform",
                        "samples uniform over the hemisphere, nearest look-up"},
    PrefilterMethodInfo{PrefilterMethod::half_vector, "half-vector",
                        "samples by half-vectors of the distribution, nearest look-up: the usual "
                        "loop"},
    PrefilterMethodInfo{PrefilterMethod::lobe, "lobe",
                        "samples in proportion to the lobe, nearest look-up"},
    PrefilterMethodInfo{PrefilterMethod::filtered, "filtered",
                        "filtered importance sampling: half-vectors, looked up in a mip pyramid"},
    PrefilterMethodInfo{PrefilterMethod::spherical_harmonics, "spherical-harmonics",
                        "the series of spherical harmonics up to a degree"},
    PrefilterMethodInfo{PrefilterMethod::fast, "fast",
                        "the series up to where it has faded, and sums over texels where needed"},
};

/// Series that were cut off undershoot beside a sun.
Rgb radiance_of(glm::dvec3 value) { return Rgb(glm::max(value, 0.0)); }

LobePlan plan_of(const Lobe& lobe, const PrefilterSettings& settings) {
  if (settings.method == PrefilterMethod::fast) return plan_lobe(lobe);
  return {zonal_factors(lobe, settings.degree), {}};
}

/// Calls value(direction) for all of them.
template <class Value>
std::vector<Rgb> at_all(std::span<const Direction> directions, const Value& value) {
  constexpr std::size_t kChunk = 64;
  std::vector<Rgb> values(directions.size());
  parallel_chunks(directions.size(), kChunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] = radiance_of(value(directions[i]));
  });
  return values;
}

/// The sampling methods, with what they share for all lobes.
class Sampling {
 public:
  Sampling(const Grid<Rgb>& map, const PrefilterSettings& settings)
      : map_(map), settings_(settings) {
    if (settings.method == PrefilterMethod::filtered) pyramid_.emplace(map);
  }

  std::vector<Rgb> operator()(const Lobe& lobe, std::span<const Direction> directions) const {
    const std::vector<LobeSample> samples = lobe_samples(lobe, sampling(), settings_.samples);
    if (pyramid_) {
      return at_all(directions, [&](Direction axis) {
        return sum_filtered(*pyramid_, samples, settings_.samples, axis);
      });
    }
    return at_all(directions, [&](Direction axis) { return sum_nearest(map_, samples, axis); });
  }

 private:
  LobeSampling sampling() const {
    if (settings_.method == PrefilterMethod::uniform) return LobeSampling::uniform;
    if (settings_.method == PrefilterMethod::lobe) return LobeSampling::lobe;
    return LobeSampling::half_vector;
  }

  const Grid<Rgb>& map_;
  const PrefilterSettings& settings_;
  std::optional<MipPyramid> pyramid_;
};

bool samples(PrefilterMethod method) {
  return method != PrefilterMethod::spherical_harmonics && method != PrefilterMethod::fast;
}

std::vector<Direction> texel_centres(Extent extent) {
  std::vector<Direction> centres;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      centres.push_back(
          direction_from_square({(x + 0.5) / extent.width, (y + 0.5) / extent.height}));
    }
  }
  return centres;
}

std::vector<Grid<Rgb>> by_sampling(const Grid<Rgb>& map, std::span<const PrefilteredLevel> levels,
                                   const PrefilterSettings& settings) {
  const Sampling sampling(map, settings);
  std::vector<Grid<Rgb>> grids;
  for (const PrefilteredLevel& level : levels) {
    auto grid = Grid<Rgb>::without_values(level.extent);
    const std::vector<Rgb> values = sampling(*level.lobe, texel_centres(level.extent));
    std::copy(values.begin(), values.end(), grid.values().begin());
    grids.push_back(std::move(grid));
  }
  return grids;
}

/// For the closed form of irradiance.
EnvironmentMap environment_of(const Grid<Rgb>& map) {
  EnvironmentMap environment;
  environment.radiance = map;
  return environment;
}

void add_cosine(Grid<Rgb>& grid, const Grid<Rgb>& map, double share) {
  const IrradianceMap irradiance = irradiance_map(environment_of(map), grid.extent());
  for (std::size_t i = 0; i < grid.values().size(); ++i) {
    grid.values()[i] =
        Rgb(glm::dvec3(grid.values()[i]) + share / kPi * irradiance.irradiance.values()[i]);
  }
}

void add_rest(Grid<Rgb>& grid, const Grid<Rgb>& map, const LobePlan& plan) {
  if (plan.cosine_share > 0.0) add_cosine(grid, map, plan.cosine_share);
  if (plan.local) {
    const Grid<glm::dvec3> sums = local_sums(map, *plan.local, plan.local_share, grid.extent());
    for (std::size_t i = 0; i < sums.values().size(); ++i) {
      grid.values()[i] = Rgb(glm::dvec3(grid.values()[i]) + sums.values()[i]);
    }
  }
  for (Rgb& value : grid.values()) value = radiance_of(value);
}

std::vector<Grid<Rgb>> by_harmonics(const Grid<Rgb>& map, std::span<const PrefilteredLevel> levels,
                                    const PrefilterSettings& settings) {
  std::vector<LobePlan> plans(levels.size());
  parallel_for(levels.size(),
               [&](std::size_t i) { plans[i] = plan_of(*levels[i].lobe, settings); });
  std::vector<ZonalFilter> filters;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // A filter of one factor, 0, where harmonics have no part.
    std::vector<double> factors = std::move(plans[i].factors);
    if (factors.empty()) factors.push_back(0.0);
    filters.push_back({std::move(factors), levels[i].extent});
  }
  std::vector<Grid<Rgb>> grids = convolve(map, filters);
  for (std::size_t i = 0; i < levels.size(); ++i) add_rest(grids[i], map, plans[i]);
  return grids;
}

/// A grid fine enough to be interpolated: four points to the shortest wave, which has faded, and
/// eight to one of half its degree. In steps of a size with small factors, for Fourier transforms.
Extent interpolation_grid(std::size_t factors) {
  constexpr std::size_t kStep = 64;
  const int height =
      static_cast<int>(kStep * std::max<std::size_t>(2, (2 * factors + kStep - 1) / kStep));
  return {2 * height, height};
}

std::vector<Rgb> by_harmonics(const Grid<Rgb>& map, const Lobe& lobe,
                              std::span<const Direction> directions,
                              const PrefilterSettings& settings) {
  const LobePlan plan = plan_of(lobe, settings);
  if (plan.factors.empty()) {
    return at_all(directions, [&](Direction axis) {
      return local_sum(map, *plan.local, plan.local_share, axis);
    });
  }
  const ZonalFilter filter = {plan.factors, interpolation_grid(plan.factors.size())};
  const Grid<Rgb> grid = std::move(convolve(map, {&filter, 1}).front());
  std::vector<Irradiance> cosine(directions.size(), Irradiance{glm::dvec3(0.0)});
  if (plan.cosine_share > 0.0) cosine = irradiances(environment_of(map), directions);
  std::vector<Rgb> values(directions.size());
  parallel_for(directions.size(), [&](std::size_t i) {
    glm::dvec3 value =
        interpolate_smooth(grid, directions[i]) + plan.cosine_share / kPi * cosine[i].rgb;
    if (plan.local) value += local_sum(map, *plan.local, plan.local_share, directions[i]);
    values[i] = radiance_of(value);
  });
  return values;
}

void check(const PrefilterSettings& settings) {
  if (samples(settings.method) && settings.samples < 1) {
    throw InputError(fmt::format("{} samples a texel: at least 1 needed", settings.samples));
  }
  if (settings.method == PrefilterMethod::spherical_harmonics &&
      (settings.degree < 0 || settings.degree > kLargestDegree)) {
    throw InputError(fmt::format("spherical harmonics of degree {}: 0 to {} needed",
                                 settings.degree, kLargestDegree));
  }
}

}  // namespace

std::span<const PrefilterMethodInfo> prefilter_methods() { return kMethods; }

PrefilterMethod prefilter_method_by_name(std::string_view name) {
  std::string names;
  for (const PrefilterMethodInfo& info : kMethods) {
    if (info.name == name) return info.method;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
  }
  throw InputError(fmt::format("no prefiltering method '{}': {} exist", name, names));
}

std::vector<Grid<Rgb>> prefilter(const Grid<Rgb>& map, std::span<const PrefilteredLevel> levels,
                                 const PrefilterSettings& settings) {
  check(settings);
  std::vector<PrefilteredLevel> blurred;
  for (const PrefilteredLevel& level : levels) {
    if (level.lobe) blurred.push_back(level);
  }
  std::vector<Grid<Rgb>> grids;
  if (!blurred.empty()) {
    grids = samples(settings.method) ? by_sampling(map, blurred, settings)
                                     : by_harmonics(map, blurred, settings);
  }
  std::vector<Grid<Rgb>> all;
  auto next = grids.begin();
  for (const PrefilteredLevel& level : levels) {
    all.push_back(level.lobe ? std::move(*next++) : resampled(map, level.extent));
  }
  return all;
}

std::vector<Rgb> prefilter(const Grid<Rgb>& map, const std::optional<Lobe>& lobe,
                           std::span<const Direction> directions,
                           const PrefilterSettings& settings) {
  check(settings);
  if (!lobe) {
    return at_all(directions, [&](Direction axis) {
      return glm::dvec3(look_up_nearest(map, square_from_direction(axis)));
    });
  }
  if (samples(settings.method)) return Sampling(map, settings)(*lobe, directions);
  return by_harmonics(map, *lobe, directions, settings);
}

}  // namespace lightproof
