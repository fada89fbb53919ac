// Time and error of prefiltering a map for GGX: specular/<method>/<map>/<W>x<H>, a chain of nine
// levels of roughness i/8, from the map's own size down, on all threads.
//
// Beside the time stand the error against the exact levels of reference/, relative to them, root
// mean square over solid angle (of all levels but the mirror: their mean square, and the worst),
// and times_usual_loop: how many times as fast as 1024 half-vectors a texel with nearest look-up,
// measured right before and after.
//
// brdf_map/<method>/<masking>/<W>x<H>: the BRDF integration map, with its largest absolute error at
// some of its texels.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bench/level_error.h"
#include "bench/registration.h"
#include "bench/timing.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/specular_chain.h"
#include "reference/texel_integrals.h"

namespace lightproof::bench {
namespace {

constexpr Extent kExtent = {512, 256};
constexpr int kLevels = 9;
using ExactChain = std::vector<Grid<glm::dvec3>>;

struct TimedMap {
  EnvironmentMap map;
  ExactChain exact;  ///< without the mirror
};

/// Made once for all benchmarks on the map, which follow each other.
const TimedMap& timed_map(std::string_view name) {
  static TimedMap timed;
  if (timed.map.name == name) return timed;
  timed = {make_synthetic_map(name, kExtent), {}};
  const std::vector<Extent> extents = level_extents(kExtent, kLevels);
  const std::vector<double> roughness = level_roughness(kLevels);
  for (std::size_t i = 1; i < extents.size(); ++i) {
    const reference::Lobe lobe = reference::ggx_lobe(roughness[i] * roughness[i]);
    timed.exact.push_back(reference::prefiltered(timed.map.radiance, lobe, extents[i]));
  }
  return timed;
}

void set_errors(benchmark::State& state, const SpecularChain& chain, const ExactChain& exact) {
  double sum = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = relative_mean_square(chain[i + 1], exact[i]);
    sum += error;
    worst = std::max(worst, error);
  }
  state.counters["relative_rms_error"] = std::sqrt(sum / static_cast<double>(exact.size()));
  state.counters["worst_level_error"] = std::sqrt(worst);
}

SpecularChain chain_of(const EnvironmentMap& map, const PrefilterSettings& settings) {
  return ggx_chain(map.radiance, kExtent, kLevels, GgxWeight::cosine, settings);
}

double usual_loop_seconds(const EnvironmentMap& map) {
  const auto start = Clock::now();
  benchmark::DoNotOptimize(chain_of(map, {PrefilterMethod::half_vector, 1024}));
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void chain_benchmark(benchmark::State& state, std::string_view map_name,
                     const PrefilterSettings& settings) {
  const TimedMap& timed = timed_map(map_name);
  const double before = usual_loop_seconds(timed.map);
  SpecularChain chain;
  const auto start = Clock::now();
  for (auto _ : state) chain = chain_of(timed.map, settings);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count() /
                         static_cast<double>(state.iterations());
  const double usual = 0.5 * (before + usual_loop_seconds(timed.map));
  state.counters["times_usual_loop"] = usual / seconds;
  set_errors(state, chain, timed.exact);
}

struct Method {
  std::string name;
  PrefilterSettings settings;
};

std::vector<Method> methods() {
  std::vector<Method> methods = {{"usual_loop_1024", {PrefilterMethod::half_vector, 1024}}};
  for (const int samples : {64, 256, 4096}) {
    methods.push_back(
        {fmt::format("half_vector_{}", samples), {PrefilterMethod::half_vector, samples}});
  }
  methods.push_back({"uniform_1024", {PrefilterMethod::uniform, 1024}});
  for (const int samples : {64, 256, 1024}) {
    methods.push_back({fmt::format("lobe_{}", samples), {PrefilterMethod::lobe, samples}});
  }
  for (const int samples : {16, 64, 256}) {
    methods.push_back({fmt::format("filtered_{}", samples), {PrefilterMethod::filtered, samples}});
  }
  for (const int degree : {8, 32, 128}) {
    methods.push_back({fmt::format("spherical_harmonics_{}", degree),
                       {PrefilterMethod::spherical_harmonics, 0, degree}});
  }
  methods.push_back({"fast", {PrefilterMethod::fast}});
  return methods;
}

struct NamedMasking {
  std::string_view name;
  Masking masking;
};
constexpr std::array<NamedMasking, 3> kMaskings = {
    {{"karis", Masking::karis},
     {"separable", Masking::separable},
     {"height-correlated", Masking::height_correlated}}};
constexpr Extent kBrdfExtent = {512, 512};

/// At every 31st texel, against quadrature with more nodes than the map's.
double brdf_map_error(const Grid<ScaleBias>& map, Masking masking) {
  double worst = 0.0;
  for (int y = 0; y < map.extent().height; y += 31) {
    for (int x = 0; x < map.extent().width; x += 31) {
      const ScaleBias exact =
          integrate_brdf((x + 0.5) / map.extent().width, (y + 0.5) / map.extent().height, masking);
      worst = std::max(
          {worst, std::abs(map(x, y).scale - exact.scale), std::abs(map(x, y).bias - exact.bias)});
    }
  }
  return worst;
}

template <class Make>
void brdf_map_benchmark(benchmark::State& state, Masking masking, const Make& make) {
  Grid<ScaleBias> map;
  for (auto _ : state) map = make();
  state.counters["largest_error"] = brdf_map_error(map, masking);
}

void register_brdf_maps() {
  for (const NamedMasking& named : kMaskings) {
    const Masking masking = named.masking;
    const std::string size = fmt::format("{}x{}", kBrdfExtent.width, kBrdfExtent.height);
    benchmark::RegisterBenchmark(
        fmt::format("brdf_map/quadrature/{}/{}", named.name, size).c_str(),
        [masking](benchmark::State& state) {
          brdf_map_benchmark(state, masking, [&] { return brdf_map(kBrdfExtent, masking); });
        })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    benchmark::RegisterBenchmark(
        fmt::format("brdf_map/hammersley_1024/{}/{}", named.name, size).c_str(),
        [masking](benchmark::State& state) {
          brdf_map_benchmark(state, masking, [&] {
            return brdf_map(kBrdfExtent, masking, HammersleyRange::published(1024));
          });
        })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(1);
  }
}

}  // namespace

void register_prefilter_benchmarks() {
  for (const char* map : {"sun-sky", "checker"}) {
    for (const Method& method : methods()) {
      benchmark::RegisterBenchmark(
          fmt::format("specular/{}/{}/{}x{}", method.name, map, kExtent.width, kExtent.height)
              .c_str(),
          [map, settings = method.settings](benchmark::State& state) {
            chain_benchmark(state, map, settings);
          })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
  register_brdf_maps();
}

}  // namespace lightproof::bench
