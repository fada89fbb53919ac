#include "lightproof/study/level_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/image/map_identity.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/prefilter.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/riemann_irradiance.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/stats/median.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kRoughness = 0.5;
/// Two-sided, of 95 %.
constexpr double kNormalQuantile = 1.959963984540054;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Of all threads of this process.
double processor_milliseconds() {
  std::timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

TimeRange range_of(const std::vector<double>& times) {
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  return {median(times), *low, *high};
}

/// A way to make a level.
struct Method {
  std::string name;
  std::string setting;
  std::function<Grid<Rgb>(const EnvironmentMap& map, Extent extent)> make;
};

/// A level that methods make, and what it should be.
struct LevelKind {
  std::string name;
  reference::Lobe exact;
  std::vector<Method> methods;
};

Method method_of(const Lobe& lobe, const PrefilterSettings& settings, std::string setting) {
  const auto info =
      std::ranges::find(prefilter_methods(), settings.method, &PrefilterMethodInfo::method);
  return {std::string(info->name), std::move(setting),
          [lobe, settings](const EnvironmentMap& map, Extent extent) {
            const PrefilteredLevel level = {lobe, extent};
            return prefilter(map.radiance, {&level, 1}, settings).front();
          }};
}

void add_sampling(std::vector<Method>& methods, const Lobe& lobe, PrefilterMethod method) {
  for (const int samples : {64, 256, 1024}) {
    methods.push_back(method_of(lobe, {method, samples}, fmt::format("{} samples", samples)));
  }
}

void add_harmonics(std::vector<Method>& methods, const Lobe& lobe) {
  for (const int degree : {2, 8, 32}) {
    methods.push_back(method_of(lobe, {PrefilterMethod::spherical_harmonics, 0, degree},
                                fmt::format("degree {}", degree)));
  }
}

Grid<Rgb> riemann_level(const EnvironmentMap& map, Extent extent) {
  const NearestRadiance radiance(map);
  Grid<Rgb> level(extent);
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) {
      level(x, y) = Rgb(riemann_reflection(radiance, normal_of_texel(extent, x, y),
                                           {64, 16, RiemannNodes::midpoint})
                            .rgb);
    }
  });
  return level;
}

LevelKind irradiance_kind() {
  const Lobe lobe = PhongLobe{1.0};
  LevelKind kind{"irradiance", reference::phong_lobe(1.0), {}};
  add_sampling(kind.methods, lobe, PrefilterMethod::uniform);
  add_sampling(kind.methods, lobe, PrefilterMethod::half_vector);
  add_sampling(kind.methods, lobe, PrefilterMethod::filtered);
  add_harmonics(kind.methods, lobe);
  kind.methods.push_back({"Riemann sum", "64 \u00d7 16 directions", riemann_level});
  kind.methods.push_back(method_of(lobe, {PrefilterMethod::fast}, ""));
  kind.methods.push_back({"closed form", "", [](const EnvironmentMap& map, Extent extent) {
                            return rounded(diffuse_map(irradiance_map(map, extent)).radiance);
                          }});
  return kind;
}

LevelKind ggx_kind() {
  const double alpha = alpha_of_roughness(kRoughness);
  const Lobe lobe = GgxLobe{alpha};
  LevelKind kind{fmt::format("GGX, roughness {}", kRoughness), reference::ggx_lobe(alpha), {}};
  add_sampling(kind.methods, lobe, PrefilterMethod::uniform);
  add_sampling(kind.methods, lobe, PrefilterMethod::half_vector);
  add_sampling(kind.methods, lobe, PrefilterMethod::lobe);
  add_sampling(kind.methods, lobe, PrefilterMethod::filtered);
  add_harmonics(kind.methods, lobe);
  kind.methods.push_back(method_of(lobe, {PrefilterMethod::fast}, ""));
  return kind;
}

/// A texel of a level, and its exact value.
struct ExactTexel {
  int x;
  int y;
  glm::dvec3 value;
};

/// Drawn in proportion to their solid angle.
std::vector<ExactTexel> exact_texels(const EnvironmentMap& map, const LevelKind& kind,
                                     const LevelCostOptions& options) {
  const RandomStream stream("level costs/" + kind.name, 1);
  std::vector<ExactTexel> texels(options.texels);
  parallel_for(texels.size(), [&](std::size_t i) {
    const SquarePoint u = stream.point(i);
    const auto [width, height] = options.level;
    const double t = std::acos(1.0 - 2.0 * u.t) / kPi;
    const int x = std::min(static_cast<int>(u.s * width), width - 1);
    const int y = std::min(static_cast<int>(t * height), height - 1);
    const Direction axis = direction_from_square({(x + 0.5) / width, (y + 0.5) / height});
    texels[i] = {x, y, reference::prefiltered(map.radiance, kind.exact, axis)};
  });
  return texels;
}

void set_error(const Grid<Rgb>& made, std::span<const ExactTexel> exact, LevelCost& cost) {
  Moments squares;
  Moments whole;
  for (const ExactTexel& texel : exact) {
    const glm::dvec3 difference = glm::dvec3(made(texel.x, texel.y)) - texel.value;
    squares.add(glm::dot(difference, difference));
    whole.add(glm::dot(texel.value, texel.value));
  }
  if (!(whole.mean() > 0.0)) return;
  const double margin = kNormalQuantile * squares.standard_error();
  cost.error = std::sqrt(squares.mean() / whole.mean());
  cost.error_low = std::sqrt(std::max(0.0, squares.mean() - margin) / whole.mean());
  cost.error_high = std::sqrt((squares.mean() + margin) / whole.mean());
}

std::vector<LevelCost> costs_of(const EnvironmentMap& map, const LevelKind& kind,
                                const LevelCostOptions& options) {
  const std::vector<ExactTexel> exact = exact_texels(map, kind, options);
  std::vector<LevelCost> costs;
  for (const Method& method : kind.methods) {
    LevelCost& cost = costs.emplace_back();
    cost.map = map.name;
    cost.map_extent = map.radiance.extent();
    cost.level = kind.name;
    cost.level_extent = options.level;
    cost.method = method.name;
    cost.setting = method.setting;
    cost.texels = exact.size();
    set_error(method.make(map, options.level), exact, cost);
  }
  std::vector<std::vector<double>> times(costs.size());
  for (int run = 0; run < options.runs; ++run) {
    for (std::size_t i = 0; i < costs.size(); ++i) {
      throw_if_interrupted();
      const auto start = Clock::now();
      kind.methods[i].make(map, options.level);
      times[i].push_back(milliseconds_since(start));
    }
  }
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i].milliseconds = range_of(times[i]);
  return costs;
}

/// Work that is done on one thread and on two.
struct SharedWork {
  std::string name;
  std::function<void()> run;
};

ThreadGain gain_of(const SharedWork& work, int runs) {
  std::vector<double> one;
  std::vector<double> two;
  double wall = 0.0;
  const auto time_on = [&](int threads) {
    const ThreadLimit limit(threads);
    const auto start = Clock::now();
    work.run();
    return milliseconds_since(start);
  };
  time_on(2);  // to warm up
  double processor = 0.0;
  for (int run = 0; run < runs; ++run) {
    const double before = processor_milliseconds();
    one.push_back(time_on(1));
    processor += processor_milliseconds() - before;
    wall += one.back();
    two.push_back(time_on(2));
  }
  return {work.name, range_of(one), range_of(two), wall / processor};
}

}  // namespace

std::vector<LevelCost> measure_level_costs(const EnvironmentMap& map,
                                           const LevelCostOptions& options) {
  require_lat_long(map, "a map for real-time rendering");
  std::vector<LevelCost> all;
  for (const LevelKind& kind : {irradiance_kind(), ggx_kind()}) {
    for (LevelCost& cost : costs_of(map, kind, options)) all.push_back(std::move(cost));
  }
  return all;
}

std::vector<ThreadGain> measure_thread_gains(const LevelCostOptions& options) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", options.gain_map);
  const auto [width, height] = options.gain_map;
  const Extent normals = {std::max(1, width / 8), std::max(1, height / 8)};
  const Extent brdf = {width, width};
  const int levels = std::min(9, static_cast<int>(std::log2(height)) + 1);
  const SharedWork works[] = {
      {fmt::format("irradiance of {}\u00d7{} normals", normals.width, normals.height),
       [&] { irradiance_map(map, normals); }},
      {fmt::format("GGX chain of {} levels from {}\u00d7{}", levels, width, height),
       [&] { ggx_chain(map.radiance, options.gain_map, levels); }},
      {fmt::format("BRDF map of {}\u00d7{}", brdf.width, brdf.height),
       [&] { brdf_map(brdf, Masking::height_correlated); }}};
  std::vector<ThreadGain> gains;
  for (const SharedWork& work : works) gains.push_back(gain_of(work, options.runs));
  return gains;
}

LevelCosts kept_level_costs(std::span<const MapRecord> maps, const LevelCostOptions& options,
                            const MeasurementCache& cache, const Progress& progress) {
  const MeasurementKeeper keeper(cache);
  const std::string setting =
      fmt::format("{} threads, {}x{}, {} texels, {} runs, {}x{}", options.threads,
                  options.level.width, options.level.height, options.texels, options.runs,
                  options.gain_map.width, options.gain_map.height);
  auto [origin, gains] = keeper.get<std::vector<ThreadGain>>(
      "thread-gains", setting, [&] { return measure_thread_gains(options); });
  LevelCosts all{{}, std::move(gains), std::move(origin)};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (progress)
      progress("levels", static_cast<double>(i + 1) / static_cast<double>(maps.size() + 1));
    const EnvironmentMap& map = maps[i].map;
    auto measured =
        keeper.get<std::vector<LevelCost>>("level-costs", setting + identity_of(map),
                                           [&] { return measure_level_costs(map, options); });
    // Only the times differ, which are texts in their order.
    all.origin = std::min(all.origin, measured.origin);
    for (LevelCost& cost : measured.value) all.levels.push_back(std::move(cost));
  }
  return all;
}

}  // namespace lightproof
