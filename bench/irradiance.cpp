// Time and error of a map of irradiance: irradiance/<method>/<map>/<normals>/<threads>.
//
//   exact          what the product makes
//   any-normals    the same of normals that share nothing
//   each-normal    one pass over the map for each normal, without tables
//   harmonics-2    spherical harmonics up to degree 2: nine coefficients; projection and map
//   harmonics-16   up to degree 16
//   riemann-64x16  the lecture's sum over 64 x 16 directions, nodes in the middle of their steps
//   cosine-1024    a plain loop over 1024 directions of density cos/pi for each normal
//
// Maps have 512 x 256 texels where their name does not say otherwise. Counters: time_ms, the
// median; largest_error and rms_error over the normals, relative to the mean of E. The truth is
// each-normal, which must lie within its certified bracket; for the row each-normal itself, exact.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/registration.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/irradiance_bracket.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/riemann_irradiance.h"
#include "lightproof/prefilter/sampled_irradiance.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/stats/median.h"

namespace lightproof::bench {
namespace {

constexpr Extent kNormals = {64, 32};

/// The map whose normals have these irradiances.
template <class OfNormal>
IrradianceMap map_by_normal(const OfNormal& of_normal) {
  IrradianceMap map = dark_irradiance_map(kNormals);
  parallel_for(kNormals.height, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < kNormals.width; ++x) {
      map.irradiance(x, y) = of_normal(normal_of_texel(kNormals, x, y));
    }
  });
  return map;
}

IrradianceMap exact(const EnvironmentMap& map) { return irradiance_map(map, kNormals); }

IrradianceMap any_normals(const EnvironmentMap& map) {
  std::vector<Direction> normals;
  for (int y = 0; y < kNormals.height; ++y) {
    for (int x = 0; x < kNormals.width; ++x) normals.push_back(normal_of_texel(kNormals, x, y));
  }
  IrradianceMap result = dark_irradiance_map(kNormals);
  std::ranges::transform(irradiances(map, normals), result.irradiance.values().begin(),
                         &Irradiance::rgb);
  return result;
}

IrradianceMap each_normal(const EnvironmentMap& map) {
  return map_by_normal([&](Direction normal) { return irradiance(map, normal).rgb; });
}

template <int kDegree>
IrradianceMap harmonics(const EnvironmentMap& map) {
  return irradiance_map(irradiance_harmonics(project(map, kDegree)), kNormals);
}

IrradianceMap riemann(const EnvironmentMap& map) {
  const NearestRadiance radiance(map);
  return map_by_normal([&](Direction normal) {
    return kPi * riemann_reflection(radiance, normal, {64, 16, RiemannNodes::midpoint}).rgb;
  });
}

IrradianceMap cosine(const EnvironmentMap& map) {
  return cosine_sampled_irradiance_map(map, kNormals, 1024, 1);
}

struct Method {
  std::string_view name;
  IrradianceMap (*run)(const EnvironmentMap&);
};
constexpr Method kMethods[] = {{"exact", exact},
                               {"any-normals", any_normals},
                               {"each-normal", each_normal},
                               {"harmonics-2", harmonics<2>},
                               {"harmonics-16", harmonics<16>},
                               {"riemann-64x16", riemann},
                               {"cosine-1024", cosine}};

struct Source {
  std::string_view name;
  std::string_view map;  ///< a built-in one
  Extent extent;
  bool all_methods;
};
constexpr Source kSources[] = {{"sun-sky", "sun-sky", {512, 256}, true},
                               {"one-texel", "one-texel", {512, 256}, true},
                               {"gradient", "gradient", {512, 256}, true},
                               {"sun-sky-2048x1024", "sun-sky", {2048, 1024}, false}};

/// A map and its true irradiance.
struct Truth {
  EnvironmentMap map;
  IrradianceMap irradiance;
  std::string why_not;  ///< if the bracket says that it is none
};

std::string outside_of_bracket(const EnvironmentMap& map, const IrradianceMap& irradiance) {
  constexpr int kDivisions = 3;
  for (int y = 0; y < kNormals.height; y += 7) {
    const int x = 5 * y % kNormals.width;
    const auto [lower, upper] =
        irradiance_bracket(map, normal_of_texel(kNormals, x, y), kDivisions);
    const glm::dvec3 value = irradiance.irradiance(x, y);
    for (int channel = 0; channel < 3; ++channel) {
      if (value[channel] >= lower.rgb[channel] && value[channel] <= upper.rgb[channel]) continue;
      return fmt::format("irradiance {} of normal ({}, {}) is not in [{}, {}]", value[channel], x,
                         y, lower.rgb[channel], upper.rgb[channel]);
    }
  }
  return {};
}

/// It stays until another one is asked for.
const Truth& truth_of(const Source& source) {
  static Truth truth;
  static std::string_view name;
  if (name != source.name) {
    truth.map = make_synthetic_map(source.map, source.extent);
    truth.irradiance = each_normal(truth.map);
    truth.why_not = outside_of_bracket(truth.map, truth.irradiance);
    name = source.name;
  }
  return truth;
}

void irradiance_benchmark(benchmark::State& state, const Method& method, const Source& source,
                          int threads) {
  const auto& [map, truth, why_not] = truth_of(source);
  if (!why_not.empty()) return disagree(state, why_not);
  const ThreadLimit limit(threads);
  const IrradianceMap made = method.run(map);
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(method.run(map));
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count());
  }
  const IrradianceError error = error_of(made, method.run == each_normal ? exact(map) : truth);
  state.counters["time_ms"] = median(std::move(times));
  state.counters["largest_error"] = error.largest;
  state.counters["rms_error"] = error.root_mean_square;
}

void register_method(const Method& method, const Source& source) {
  for (const auto& [threads, count] : {std::pair{"one-thread", 1}, {"all-threads", 0}}) {
    const std::string name = fmt::format("irradiance/{}/{}/{}x{}/{}", method.name, source.name,
                                         kNormals.width, kNormals.height, threads);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&method, &source, count = count](benchmark::State& state) {
                                   irradiance_benchmark(state, method, source, count);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

}  // namespace

void register_irradiance_benchmarks() {
  for (const Source& source : kSources) {
    for (const Method& method : kMethods) {
      if (source.all_methods || method.run == exact) register_method(method, source);
    }
  }
}

}  // namespace lightproof::bench
