// Time to draw one direction with its density per steradian, which is what a renderer needs:
// directions/<sampler>/<map>/<W>x<H>/<density>/<order>.
//
//   scalar     one at a time, at random points that were generated beforehand
//   ahead      the same, each sample begun (prepare) eight samples before it is finished
//   batch      the same points, in batches
//   fused      in batches, random numbers included
//   positions  as fused, but as positions over the map with their density over it
//
// All carry times_baseline, how many times as fast they are as the usual way: std::upper_bound over
// sums in float, and the library's sine and cosine. `fused` carries share_of_limit too, of the
// speed of a bare gather from a table of two bytes a texel with one reciprocal square root and one
// sine and cosine a sample. Both are measured beside the sampler.
//
// A plug-in (--plugin FILE) is timed as `batch`, by the clocks of its own process, with the way
// there and back left out; the name then ends in /manual_time.
//
// Before a sampler is timed its samples are checked, as for sample/, and its directions must be
// those of its samples.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/bare_gather.h"
#include "bench/maps.h"
#include "bench/prepared.h"
#include "bench/registration.h"
#include "bench/timing.h"
#include "bench/upper_bound_baseline.h"
#include "lightproof/core/error.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/plugin/plugin_library.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::bench {
namespace {

/// How many samples lie between the beginning and the end of one: a power of two.
constexpr std::size_t kAhead = 8;

/// Directions of one batch.
class DirectionBuffer {
 public:
  DirectionBatch batch() {
    return {part(0),
            part(1),
            part(2),
            part(3),
            std::span(texels_).first(kBatch),
            std::span(texels_).last(kBatch)};
  }

 private:
  std::span<double> part(std::size_t i) { return std::span(numbers_).subspan(i * kBatch, kBatch); }

  std::vector<double> numbers_ = std::vector<double>(4 * kBatch);
  std::vector<std::int32_t> texels_ = std::vector<std::int32_t>(2 * kBatch);
};

std::span<const SquarePoint> batch_of_points(std::uint64_t first) {
  return random_points().subspan(first % random_points().size(), kBatch);
}

/// What speed is compared with, of the last size and density that were asked for.
struct Baselines {
  Baselines(Extent extent, DensitySpace density_space)
      : baseline(map_of(extent), density_space), limit(extent) {}

  UpperBoundBaseline baseline;
  BareGather limit;
};

const Baselines& baselines_of(Extent extent, DensitySpace density_space) {
  static std::unique_ptr<Baselines> the_last;
  static Extent size;
  static DensitySpace space;
  if (!the_last || !(size == extent) || space != density_space) {
    the_last.reset();
    the_last = std::make_unique<Baselines>(extent, density_space);
    size = extent;
    space = density_space;
  }
  return *the_last;
}

/// Draws directions one at a time at points that are given.
template <class Direction>
auto draw_scalar(const Direction& direction) {
  return [&direction](std::uint64_t first) {
    for (const SquarePoint u : batch_of_points(first)) {
      const LightSample sample = direction(u);
      benchmark::DoNotOptimize(sample);
    }
  };
}

template <class Sampler>
auto draw_ahead(const Sampler& sampler) {
  return [&sampler](std::uint64_t first) {
    const std::span<const SquarePoint> points = batch_of_points(first);
    std::array<decltype(sampler.prepare(points[0])), kAhead> begun;
    for (std::size_t i = 0; i < kAhead; ++i) begun[i] = sampler.prepare(points[i]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LightSample sample = finish_direction(sampler, begun[i % kAhead]);
      begun[i % kAhead] = sampler.prepare(points[std::min(i + kAhead, points.size() - 1)]);
      benchmark::DoNotOptimize(sample);
    }
  };
}

template <class Sampler>
auto draw_batch_of(const Sampler& sampler) {
  return [&sampler, buffer = std::make_shared<DirectionBuffer>()](std::uint64_t first) {
    const DirectionBatch directions = buffer->batch();
    sample_directions(sampler, batch_of_points(first), directions);
    benchmark::DoNotOptimize(directions.pdf.data());
    benchmark::ClobberMemory();
  };
}

template <class Sampler>
auto draw_fused(const Sampler& sampler) {
  return [&sampler, buffer = std::make_shared<DirectionBuffer>()](std::uint64_t first) {
    const DirectionBatch directions = buffer->batch();
    sample_directions(sampler, fused_stream(), first, directions);
    benchmark::DoNotOptimize(directions.pdf.data());
    benchmark::ClobberMemory();
  };
}

template <class Sampler>
auto draw_positions(const Sampler& sampler) {
  return [&sampler,
          samples = std::make_shared<std::vector<TexelSample>>(kBatch)](std::uint64_t first) {
    sample(sampler, fused_stream(), first, *samples);
    benchmark::DoNotOptimize(samples->data());
    benchmark::ClobberMemory();
  };
}

/// The baseline with random numbers included.
auto draw_fused_baseline(const UpperBoundBaseline& baseline) {
  return [&baseline, points = std::make_shared<std::vector<SquarePoint>>(kBatch),
          buffer = std::make_shared<DirectionBuffer>()](std::uint64_t first) {
    const DirectionBatch directions = buffer->batch();
    fill_points(fused_stream(), first, *points);
    for (std::size_t i = 0; i < kBatch; ++i) put(baseline.direction((*points)[i]), i, directions);
    benchmark::DoNotOptimize(directions.pdf.data());
    benchmark::ClobberMemory();
  };
}

auto draw_limit(const BareGather& limit) {
  return [&limit](std::uint64_t first) {
    benchmark::DoNotOptimize(limit.read_directions(fused_stream(), first, kBatch));
  };
}

/// Times `draw`, and sets the ratio to what is measured on either side of it, so that a change of
/// the machine's speed cancels.
template <class Draw, class Baseline>
void time_against(benchmark::State& state, const Draw& draw, const Baseline& baseline) {
  const double before = ns_per_sample(baseline);
  time_batches(state, draw);
  const double mean = 0.5 * (before + ns_per_sample(baseline));
  state.counters["times_baseline"] = mean / state.counters["ns_per_sample"];
}

enum class Order { scalar, ahead, batch, fused, positions };

template <class Sampler>
void time_order(benchmark::State& state, const Sampler& sampler, const Baselines& baselines,
                Order order) {
  const auto usual = [&](SquarePoint u) { return baselines.baseline.direction(u); };
  const auto ours = [&](SquarePoint u) { return sample_direction(sampler, u); };
  switch (order) {
    case Order::scalar:
      return time_against(state, draw_scalar(ours), draw_scalar(usual));
    case Order::ahead:
      if constexpr (PreparingSampler<Sampler>) {
        return time_against(state, draw_ahead(sampler), draw_scalar(usual));
      }
      return;
    case Order::batch:
      return time_against(state, draw_batch_of(sampler), draw_scalar(usual));
    case Order::positions:
      return time_against(state, draw_positions(sampler), draw_fused_baseline(baselines.baseline));
    case Order::fused: {
      const double before = ns_per_sample(draw_limit(baselines.limit));
      time_against(state, draw_fused(sampler), draw_fused_baseline(baselines.baseline));
      const double limit = 0.5 * (before + ns_per_sample(draw_limit(baselines.limit)));
      state.counters["share_of_limit"] = limit / state.counters["ns_per_sample"];
    }
  }
}

/// An explanation if a direction is not that of the sample at the same point; empty if all are.
template <class Sampler>
std::string other_direction(const Sampler& sampler) {
  const std::span<const SquarePoint> points = batch_of_points(0);
  DirectionBuffer buffer;
  const DirectionBatch batch = buffer.batch();
  sample_directions(sampler, points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TexelSample sample = sampler.sample(points[i]);
    const Direction expected = direction_from_square(sample.at);
    const double pdf = to_solid_angle(sample.pdf, sample.at).value;
    // Positions beside a pole lose digits of their distance from it.
    const double roundings = 1e-12 + 1e-15 / sin_theta(sample.at.t);
    const double away = std::abs(batch.x[i] - expected.x) + std::abs(batch.y[i] - expected.y) +
                        std::abs(batch.z[i] - expected.z);
    if (away <= roundings && std::abs(batch.pdf[i] / pdf - 1.0) <= roundings &&
        batch.column[i] == sample.x && batch.row[i] == sample.y) {
      continue;
    }
    return fmt::format("u = ({:.17g}, {:.17g}): the direction is not the sample's", points[i].s,
                       points[i].t);
  }
  return "";
}

void directions_benchmark(benchmark::State& state, const SamplerInfo& info, Extent extent,
                          DensitySpace density_space, Order order) {
  const Prepared& ready = prepared(info, extent, density_space);
  if (!ready.why_not.empty()) return disagree(state, ready.why_not);
  std::visit(
      [&](const auto& sampler) {
        if (const std::string why = other_direction(sampler); !why.empty()) {
          return disagree(state, why);
        }
        time_order(state, sampler, baselines_of(extent, density_space), order);
        state.counters["table_bytes"] = static_cast<double>(sampler.table_bytes());
      },
      *ready.sampler);
}

struct OrderInfo {
  Order order;
  std::string_view name;
};
constexpr std::array<OrderInfo, 5> kOrders = {{{Order::scalar, "scalar"},
                                               {Order::ahead, "ahead"},
                                               {Order::batch, "batch"},
                                               {Order::fused, "fused"},
                                               {Order::positions, "positions"}}};

bool prepares(const SamplerInfo& info) {
  static const EnvironmentMap small = map_of({16, 8});
  return std::visit([]<class Sampler>(const Sampler&) { return PreparingSampler<Sampler>; },
                    info.make(small, DensitySpace::texture));
}

std::string name_of(std::string_view sampler, Extent extent, DensitySpace density_space,
                    std::string_view order) {
  return fmt::format("directions/{}/{}/{}x{}/{}/{}", sampler, kMap, extent.width, extent.height,
                     to_string(density_space), order);
}

void register_baselines(Extent extent, DensitySpace density_space) {
  const auto add = [&](std::string_view name, std::string_view order, auto make_draw) {
    benchmark::RegisterBenchmark(name_of(name, extent, density_space, order).c_str(),
                                 [extent, density_space, make_draw](benchmark::State& state) {
                                   time_batches(state,
                                                make_draw(baselines_of(extent, density_space)));
                                 });
  };
  add("upper_bound_baseline", "fused",
      [](const Baselines& all) { return draw_fused_baseline(all.baseline); });
  add("bare_gather_2B", "fused", [](const Baselines& all) { return draw_limit(all.limit); });
}

void register_orders(const SamplerInfo& info, Extent extent, DensitySpace density_space) {
  for (const auto& [order, order_name] : kOrders) {
    if (order == Order::ahead && !prepares(info)) continue;
    benchmark::RegisterBenchmark(
        name_of(info.name, extent, density_space, order_name).c_str(),
        [&info, extent, density_space, order = order](benchmark::State& state) {
          directions_benchmark(state, info, extent, density_space, order);
        });
  }
}

/// The plug-in's process with the map of a size: of the last one that was asked for.
const TimedPlugin& timed_plugin(const PluginLibrary& library, Extent extent) {
  static std::unique_ptr<TimedPlugin> the_last;
  static const PluginLibrary* of;
  static Extent size;
  if (!the_last || of != &library || !(size == extent)) {
    the_last.reset();
    the_last = std::make_unique<TimedPlugin>(library, map_of(extent));
    of = &library;
    size = extent;
  }
  return *the_last;
}

/// Batches of a plug-in, timed inside of its own process; the baseline as ever in this one.
void time_plugin(benchmark::State& state, const PluginLibrary& library, Extent extent) {
  const TimedPlugin& plugin = timed_plugin(library, extent);
  const UpperBoundBaseline& usual = baselines_of(extent, library.target().density_space).baseline;
  const auto baseline = [&](SquarePoint u) { return usual.direction(u); };
  const double before = ns_per_sample(draw_scalar(baseline));
  std::uint64_t first = 0;
  for (int warm = 0; warm < 4; ++warm, first += kBatch) plugin.draw(batch_of_points(first));
  PluginTime all;
  for (auto _ : state) {
    const PluginTime time = plugin.draw(batch_of_points(first));
    all.cpu_nanoseconds += time.cpu_nanoseconds;
    all.wall_nanoseconds += time.wall_nanoseconds;
    state.SetIterationTime(1e-9 * time.wall_nanoseconds * static_cast<double>(kBatch));
    first += kBatch;
  }
  const double mean = 0.5 * (before + ns_per_sample(draw_scalar(baseline)));
  const double ns = all.cpu_nanoseconds / static_cast<double>(state.iterations());
  state.counters["ns_per_sample"] = ns;
  state.counters["times_baseline"] = mean / ns;
  state.counters["wall_per_cpu"] = all.wall_nanoseconds / all.cpu_nanoseconds;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
}

void plugin_benchmark(benchmark::State& state, const std::shared_ptr<const PluginLibrary>& library,
                      Extent extent) {
  try {
    std::vector<TexelSample> samples(points_of_fit().size());
    bound_plugin(library, map_of(extent), std::make_shared<PluginNotes>())
        .sample(points_of_fit(), samples);
    const std::string why = misfit_of(samples, library->target(), extent);
    if (!why.empty()) return disagree(state, why);
    time_plugin(state, *library, extent);
  } catch (const SamplerFailure& failure) {
    disagree(state, failure.what());
  }
}

}  // namespace

void register_plugin_benchmarks(std::span<const std::string> files) {
  for (const std::string& file : files) {
    const auto library = std::make_shared<const PluginLibrary>(file, PluginOptions{});
    if (!library->description().has_sample) {
      throw InputError(fmt::format("{}: it draws in an order of its own, and is not timed", file));
    }
    for (const Extent extent : kExtents) {
      const std::string name =
          name_of(library->name(), extent, library->target().density_space, "batch");
      benchmark::RegisterBenchmark(name.c_str(), [library, extent](benchmark::State& state) {
        plugin_benchmark(state, library, extent);
      })->UseManualTime();
    }
  }
}

void register_direction_benchmarks() {
  for (const Extent extent : kExtents) {
    for (const DensitySpace density_space : kDensitySpaces) {
      register_baselines(extent, density_space);
      for (const SamplerInfo& info : samplers()) register_orders(info, extent, density_space);
    }
  }
}

}  // namespace lightproof::bench
