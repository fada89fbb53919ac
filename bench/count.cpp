// Work of fixed size to count instructions of: count/<sampler>/<map>/<W>x<H>, 2^14 samples, once,
// one at a time, and count/<sampler>/<map>/<W>x<H>/fused, as many in batches with random numbers of
// their own.
//
// For `valgrind --tool=callgrind --toggle-collect='*counted_kernel*'`, which counts what happens
// inside of that function and nothing else (ci/perf does so). The map is small: the number of
// instructions does not depend on caches, and an emulator takes its time. What is wrong with a
// sampler, sample/ says before it times it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/registration.h"
#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"

namespace lightproof::bench {
namespace {

constexpr std::string_view kMap = "sun-sky";
constexpr Extent kExtent = {512, 256};
constexpr std::size_t kPoints = std::size_t{1} << 14U;

std::vector<SquarePoint> make_points() {
  const RandomStream stream("bench/count", 1);
  std::vector<SquarePoint> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) points.push_back(stream.point(i));
  return points;
}

/// A function of its own, which the emulator finds by its name.
template <class Sampler>
[[gnu::noinline]] void counted_kernel(const Sampler& sampler, std::span<const SquarePoint> points) {
  for (const SquarePoint u : points) benchmark::DoNotOptimize(sampler.sample(u));
}

template <class Sampler>
[[gnu::noinline]] void fused_counted_kernel(const Sampler& sampler, const RandomStream& stream,
                                            std::span<TexelSample> samples) {
  sample(sampler, stream, 0, samples);
}

template <class Sampler>
void count_one_at_a_time(benchmark::State& state, const Sampler& sampler) {
  const std::vector<SquarePoint> points = make_points();
  for (auto _ : state) counted_kernel(sampler, points);
}

template <class Sampler>
void count_fused(benchmark::State& state, const Sampler& sampler) {
  const RandomStream stream("bench/count", 1);
  std::vector<TexelSample> samples(kPoints);
  for (auto _ : state) {
    fused_counted_kernel(sampler, stream, samples);
    benchmark::DoNotOptimize(samples.data());
  }
}

void count_benchmark(benchmark::State& state, const SamplerInfo& info, bool fused) {
  const EnvironmentMap map = make_synthetic_map(kMap, kExtent);
  const AnySampler any = info.make(map, DensitySpace::texture);
  std::visit(
      [&](const auto& sampler) {
        fused ? count_fused(state, sampler) : count_one_at_a_time(state, sampler);
      },
      any);
  state.counters["samples"] = static_cast<double>(kPoints);
}

}  // namespace

void register_count_benchmarks() {
  for (const SamplerInfo& info : samplers()) {
    const std::string name =
        fmt::format("count/{}/{}/{}x{}", info.name, kMap, kExtent.width, kExtent.height);
    for (const bool fused : {false, true}) {
      benchmark::RegisterBenchmark(
          (name + (fused ? "/fused" : "")).c_str(),
          [&info, fused](benchmark::State& state) { count_benchmark(state, info, fused); })
          ->Iterations(1);
    }
  }
}

}  // namespace lightproof::bench
