// Time to draw one sample: sample/<sampler>/<map>/<W>x<H>/<order>.
//
//   random   one at a time, at random points that were generated beforehand, so many that the parts
//            of a table that they reach do not stay in the cache
//   batch    the same points, in batches
//   fused    in batches, random numbers included; with the ratios to the baselines, both measured
//            beside it: times_baseline, how many times as fast as std::upper_bound, and
//            share_of_limit, of the speed of a bare gather from a table of two bytes a texel
//
// Of the sizes between powers of two there is `random` alone.
//
// The sampler's type is static inside the loop. Before a sampler is timed, its samples must fit the
// bins of reference/, and if it searches sums, its texels must be those of reference/.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "bench/bare_gather.h"
#include "bench/maps.h"
#include "bench/prepared.h"
#include "bench/registration.h"
#include "bench/timing.h"
#include "bench/upper_bound_baseline.h"
#include "lightproof/core/random.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"

namespace lightproof::bench {
namespace {

bool disagreed = false;

template <class Sampler>
void time_random(benchmark::State& state, const Sampler& sampler) {
  const std::span<const SquarePoint> points = random_points();
  for (std::size_t i = 0; i < 256; ++i) benchmark::DoNotOptimize(sampler.sample(points[i]));
  std::size_t next = 0;
  const auto start = Clock::now();
  for (auto _ : state) {
    const TexelSample sample = sampler.sample(points[next]);
    benchmark::DoNotOptimize(sample);
    next = (next + 1) % points.size();
  }
  state.counters["ns_per_sample"] =
      nanoseconds_since(start) / static_cast<double>(state.iterations());
  state.SetItemsProcessed(state.iterations());
}

template <class Sampler>
void time_batch(benchmark::State& state, const Sampler& sampler) {
  std::vector<TexelSample> samples(kBatch);
  time_batches(state, [&](std::uint64_t first) {
    sample(sampler, random_points().subspan(first % random_points().size(), kBatch), samples);
    benchmark::DoNotOptimize(samples.data());
    benchmark::ClobberMemory();
  });
}

/// What speed is compared with, of the last size that was asked for.
struct Baselines {
  explicit Baselines(Extent extent) : baseline(map_of(extent)), limit(extent) {}

  UpperBoundBaseline baseline;
  BareGather limit;
};

const Baselines& baselines_of(Extent extent) {
  static std::unique_ptr<Baselines> the_last;
  static Extent size;
  if (!the_last || !(size == extent)) {
    the_last.reset();
    the_last = std::make_unique<Baselines>(extent);
    size = extent;
  }
  return *the_last;
}

auto draw_baseline(const UpperBoundBaseline& baseline) {
  return [&baseline, points = std::vector<SquarePoint>(kBatch),
          samples = std::vector<TexelSample>(kBatch)](std::uint64_t first) mutable {
    fill_points(fused_stream(), first, points);
    for (std::size_t i = 0; i < kBatch; ++i) samples[i] = baseline.sample(points[i]);
    benchmark::DoNotOptimize(samples.data());
    benchmark::ClobberMemory();
  };
}

auto draw_limit(const BareGather& limit) {
  return [&limit](std::uint64_t first) {
    benchmark::DoNotOptimize(limit.read(fused_stream(), first, kBatch));
  };
}

template <class Sampler>
void time_fused(benchmark::State& state, const Sampler& sampler, Extent extent) {
  const Baselines& baselines = baselines_of(extent);
  std::vector<TexelSample> samples(kBatch);
  auto baseline = draw_baseline(baselines.baseline);
  const double before[] = {ns_per_sample(std::ref(baseline)),
                           ns_per_sample(draw_limit(baselines.limit))};
  time_batches(state, [&](std::uint64_t first) {
    sample(sampler, fused_stream(), first, samples);
    benchmark::DoNotOptimize(samples.data());
    benchmark::ClobberMemory();
  });
  // On either side of the sampler's time, so that a change of the machine's speed cancels.
  const double base = 0.5 * (before[0] + ns_per_sample(std::ref(baseline)));
  const double limit = 0.5 * (before[1] + ns_per_sample(draw_limit(baselines.limit)));
  const double time = state.counters["ns_per_sample"];
  state.counters["times_baseline"] = base / time;
  state.counters["share_of_limit"] = limit / time;
}

void set_table_counters(benchmark::State& state, std::size_t bytes, Extent extent) {
  state.counters["table_bytes"] = static_cast<double>(bytes);
  state.counters["bytes_per_texel"] =
      static_cast<double>(bytes) / static_cast<double>(extent.count());
}

enum class Order { random, batch, fused };

void sample_benchmark(benchmark::State& state, const SamplerInfo& info, Extent extent,
                      Order order) {
  const Prepared& prepared_sampler = prepared(info, extent);
  if (!prepared_sampler.why_not.empty()) return disagree(state, prepared_sampler.why_not);
  std::visit(
      [&](const auto& sampler) {
        switch (order) {
          case Order::random:
            time_random(state, sampler);
            break;
          case Order::batch:
            time_batch(state, sampler);
            break;
          case Order::fused:
            time_fused(state, sampler, extent);
        }
        set_table_counters(state, sampler.table_bytes(), extent);
      },
      *prepared_sampler.sampler);
  state.counters["build_ms"] = prepared_sampler.build_ms;
  if (draws_texels(info)) state.counters["worst_texel_error"] = prepared_sampler.worst_texel_error;
}

void baseline_benchmark(benchmark::State& state, Extent extent) {
  const UpperBoundBaseline& baseline = baselines_of(extent).baseline;
  auto draw = draw_baseline(baseline);
  time_batches(state, std::ref(draw));
  set_table_counters(state, baseline.table_bytes(), extent);
  state.counters["worst_texel_error"] =
      worst_texel_error(extent, {DensitySpace::texture, kRec709},
                        [&](SquarePoint at) { return baseline.pdf(at).value; });
}

void limit_benchmark(benchmark::State& state, Extent extent) {
  const BareGather& limit = baselines_of(extent).limit;
  time_batches(state, draw_limit(limit));
  set_table_counters(state, limit.table_bytes(), extent);
}

struct OrderInfo {
  Order order;
  std::string_view name;
};
constexpr std::array<OrderInfo, 3> kOrders = {
    {{Order::random, "random"}, {Order::batch, "batch"}, {Order::fused, "fused"}}};

struct BaselineInfo {
  std::string_view name;
  void (*run)(benchmark::State&, Extent);
};
constexpr std::array<BaselineInfo, 2> kBaselines = {
    {{"upper_bound_baseline", baseline_benchmark}, {"bare_gather_2B", limit_benchmark}}};

std::string name_of(std::string_view sampler, Extent extent, std::string_view order) {
  return fmt::format("sample/{}/{}/{}x{}/{}", sampler, kMap, extent.width, extent.height, order);
}

void register_samplers(Extent extent, std::span<const OrderInfo> orders) {
  for (const SamplerInfo& info : samplers()) {
    for (const auto& [order, order_name] : orders) {
      const std::string name = name_of(info.name, extent, order_name);
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&info, extent, order = order](benchmark::State& state) {
                                     sample_benchmark(state, info, extent, order);
                                   });
    }
  }
}

}  // namespace

void disagree(benchmark::State& state, const std::string& why) {
  disagreed = true;
  state.SkipWithError(why.c_str());
}

bool any_disagreement() { return disagreed; }

void register_sample_benchmarks() {
  for (const Extent extent : kExtents) {
    for (const BaselineInfo& baseline : kBaselines) {
      const std::string name = name_of(baseline.name, extent, "fused");
      benchmark::RegisterBenchmark(name.c_str(), [&baseline, extent](benchmark::State& state) {
        baseline.run(state, extent);
      });
    }
    register_samplers(extent, kOrders);
    if (extent == kExtents.back()) continue;
    register_samplers(half_as_large_again(extent), std::span(kOrders).first<1>());
  }
}

}  // namespace lightproof::bench
