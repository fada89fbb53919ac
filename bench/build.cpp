// Time to build a sampler of a map: build/<sampler>/<map>/<W>x<H>/<threads>.
//
// Beside them, on one thread, what they are compared with: build/copy_of_map/…, the map copied into
// memory that is there already, and build/vose_baseline/…, the usual build of an alias table from
// luminances. All others get their memory fresh. Counter: build_ms, the median.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/maps.h"
#include "bench/registration.h"
#include "bench/vose_baseline.h"
#include "lightproof/core/parallel.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/stats/median.h"

namespace lightproof::bench {
namespace {

template <class Build>
void time_builds(benchmark::State& state, const Build& build) {
  build();  // which brings in the map, and starts the threads
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    build();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count());
  }
  state.counters["build_ms"] = median(std::move(times));
}

void copy_benchmark(benchmark::State& state, Extent extent) {
  const std::span<const Rgb> texels = map_of(extent).radiance.values();
  std::vector<Rgb> copy(texels.size());
  time_builds(state, [&] {
    std::ranges::copy(texels, copy.begin());
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  });
}

void vose_benchmark(benchmark::State& state, Extent extent) {
  std::vector<float> weights;
  for (const Rgb rgb : map_of(extent).radiance.values()) {
    weights.push_back(static_cast<float>(luminance_of(rgb, kRec709)));
  }
  time_builds(state, [&] { benchmark::DoNotOptimize(build_vose(weights)); });
}

void sampler_benchmark(benchmark::State& state, const SamplerInfo& info, Extent extent,
                       int threads) {
  const EnvironmentMap& map = map_of(extent);
  const ThreadLimit limit(threads);
  time_builds(state, [&] { benchmark::DoNotOptimize(info.make(map, DensitySpace::texture)); });
}

struct Threads {
  std::string_view name;
  int count;  ///< 0: all
};
constexpr std::array<Threads, 2> kThreads = {{{"one-thread", 1}, {"all-threads", 0}}};

struct BaselineBuild {
  std::string_view name;
  void (*run)(benchmark::State&, Extent);
};
constexpr std::array<BaselineBuild, 2> kBaselines = {
    {{"copy_of_map", copy_benchmark}, {"vose_baseline", vose_benchmark}}};

std::string name_of(std::string_view what, Extent extent, std::string_view threads) {
  return fmt::format("build/{}/{}/{}x{}/{}", what, kMap, extent.width, extent.height, threads);
}

void register_samplers(Extent extent) {
  for (const SamplerInfo& info : samplers()) {
    for (const Threads& threads : kThreads) {
      const std::string name = name_of(info.name, extent, threads.name);
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&info, extent, &threads](benchmark::State& state) {
                                     sampler_benchmark(state, info, extent, threads.count);
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
}

}  // namespace

void register_build_benchmarks() {
  for (const Extent extent : kExtents) {
    for (const BaselineBuild& baseline : kBaselines) {
      const std::string name = name_of(baseline.name, extent, "one-thread");
      benchmark::RegisterBenchmark(
          name.c_str(),
          [&baseline, extent](benchmark::State& state) { baseline.run(state, extent); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
    register_samplers(extent);
  }
}

}  // namespace lightproof::bench
