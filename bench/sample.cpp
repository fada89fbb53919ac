// Time to draw one sample: sample/<sampler>/<map>/<W>x<H>/<order>.
//
//   random   one at a time, at random points that were generated beforehand, so many that the parts
//            of a table that they reach do not stay in the cache
//   batch    the same points, in batches
//   fused    in batches, random numbers included; with the ratios to the yardsticks, both measured
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
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/bare_gather.h"
#include "bench/maps.h"
#include "bench/registration.h"
#include "bench/upper_bound_baseline.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/suite/draws.h"
#include "reference/slow_sampler.h"
#include "reference/texel_masses.h"

namespace lightproof::bench {
namespace {

constexpr std::size_t kPoints = std::size_t{1} << 21U;
constexpr std::size_t kFitted = std::size_t{1} << 16U;
/// Far beyond chance: the points are the same in every run.
constexpr double kLeastLog10P = -6.0;
/// The lecture's weighting.
constexpr Weighting kWeighting = Weighting::A;

bool disagreed = false;

const reference::SlowSampler& reference_of(Extent extent, TargetDensity target) {
  static std::unique_ptr<reference::SlowSampler> sampler;
  static Extent made_for;
  static double made_with = 0.0;
  if (!sampler || !(made_for == extent) || made_with != target.grey.red) {
    sampler.reset();
    sampler = std::make_unique<reference::SlowSampler>(map_of(extent), target);
    made_for = extent;
    made_with = target.grey.red;
  }
  return *sampler;
}

std::vector<SquarePoint> make_points() {
  const RandomStream stream("bench/sample", 1);
  std::vector<SquarePoint> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) points.push_back(stream.point(i));
  return points;
}

std::span<const SquarePoint> random_points() {
  static const std::vector<SquarePoint> points = make_points();
  return points;
}

/// The law that all samplers of this target draw.
struct Law {
  Grid<double> masses;
  std::vector<double> bins;
};

const Law& law_of(Extent extent, TargetDensity target) {
  static Law law;
  static Extent made_for;
  static TargetDensity made_with = {};
  if (!(made_for == extent) || !(made_with == target)) {
    law = {};
    law.masses = reference::texel_masses(map_of(extent), target);
    const bool draws_whole_texels = target.lookup == Lookup::nearest;
    law.bins = serpentine(draws_whole_texels
                              ? reference::bin_masses(law.masses, target.weighting, kGateBins)
                              : reference::bin_masses(map_of(extent), target, kGateBins));
    made_for = extent;
    made_with = target;
  }
  return law;
}

/// How far from a knot of the exact distribution a sampler may take the neighbour: the rounding of
/// its own sums. Of n terms they drift by up to n steps.
double knot_tolerance(const SamplerInfo& sampler, Extent extent) {
  return (extent.width + extent.height) * sampler.resolution;
}

/// An explanation if the samples do not fit the reference's bins; empty if they do.
template <class Sampler>
std::string misfit(const Sampler& sampler, const SamplerInfo& info, Extent extent) {
  Grid<std::uint64_t> counts(kGateBins);
  std::uint64_t count = 0;
  for (const SquarePoint u : random_points().first(kFitted)) {
    const TexelSample sample = sampler.sample(u);
    if (!is_on_map(sample, extent)) continue;
    ++count;
    ++counts(cell_of(sample.at.s, kGateBins.width), cell_of(sample.at.t, kGateBins.height));
  }
  const double log10_p =
      cressie_read(serpentine(counts), law_of(extent, info.target(kWeighting)).bins, count).log10_p;
  return log10_p > kLeastLog10P
             ? ""
             : fmt::format("the samples do not fit the map: log10 p = {}", log10_p);
}

/// An explanation if a texel is not the reference's; empty if all are. The reference draws whole
/// texels: it says nothing of a look-up that interpolates.
template <class Sampler>
std::string disagreement(const Sampler& sampler, const SamplerInfo& info, Extent extent) {
  const bool sums_texels = info.resolution != 0.0 && info.lookup == Lookup::nearest;
  if (!sums_texels) return "";
  const auto& reference = reference_of(extent, info.target(kWeighting));
  const double tolerance = knot_tolerance(info, extent);
  for (const SquarePoint u : random_points().first(256)) {
    const TexelSample sample = sampler.sample(u);
    if (reference::Texel{sample.x, sample.y} == reference.sample(u)) continue;
    if (reference.near_knot(u, tolerance)) continue;
    return fmt::format("u = ({:.17g}, {:.17g}): texel ({}, {}) is not the reference's", u.s, u.t,
                       sample.x, sample.y);
  }
  return "";
}

/// An explanation if a batch draws other texels than the sampler does one at a time.
template <class Sampler>
std::string other_batch(const Sampler& sampler) {
  const std::span<const SquarePoint> points = random_points().first(4099);
  std::vector<TexelSample> batch(points.size());
  sample(sampler, points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TexelSample alone = sampler.sample(points[i]);
    if (alone.x == batch[i].x && alone.y == batch[i].y) continue;
    return fmt::format("u = ({:.17g}, {:.17g}): the batch's texel is ({}, {}), alone ({}, {})",
                       points[i].s, points[i].t, batch[i].x, batch[i].y, alone.x, alone.y);
  }
  return "";
}

/// The largest relative difference between the probability with which a texel is drawn, which is
/// what the sampler says, and its share of the light. Of texels without light, which are drawn by
/// none.
template <class Sampler>
double worst_texel_error(const Sampler& sampler, const Grid<double>& masses) {
  const Extent extent = masses.extent();
  const double texels = static_cast<double>(extent.count());
  std::vector<double> worst(static_cast<std::size_t>(extent.height));
  parallel_for(worst.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) {
      if (!(masses(x, y) > 0.0)) continue;
      const SquarePoint centre = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
      const double drawn = sampler.pdf(centre).value / texels;
      worst[row] = std::max(worst[row], std::abs(drawn / masses(x, y) - 1.0));
    }
  });
  return *std::ranges::max_element(worst);
}

/// With the probability that it says, whole.
bool draws_texels(const SamplerInfo& info) {
  return !info.known_defects && info.lookup == Lookup::nearest;
}

/// A sampler that was built and checked: once, though Google Benchmark runs a benchmark several
/// times.
struct Prepared {
  std::optional<AnySampler> sampler;
  double build_ms = 0.0;
  double worst_texel_error = 0.0;
  std::string why_not;
};

const Prepared& prepared(const SamplerInfo& info, Extent extent) {
  static Prepared the_last;
  static std::string name;
  static Extent size;
  if (name == info.name && size == extent) return the_last;
  the_last = {};
  name.clear();
  const EnvironmentMap& map = map_of(extent);
  const auto start = std::chrono::steady_clock::now();
  the_last.sampler.emplace(info.make(map, kWeighting));
  const std::chrono::duration<double, std::milli> build = std::chrono::steady_clock::now() - start;
  the_last.build_ms = build.count();
  std::visit(
      [&](const auto& sampler) {
        the_last.why_not = misfit(sampler, info, extent);
        if (the_last.why_not.empty()) the_last.why_not = disagreement(sampler, info, extent);
        if (the_last.why_not.empty()) the_last.why_not = other_batch(sampler);
        if (!draws_texels(info)) return;
        const Grid<double>& masses = law_of(extent, info.target(kWeighting)).masses;
        the_last.worst_texel_error = worst_texel_error(sampler, masses);
      },
      *the_last.sampler);
  name = info.name;
  size = extent;
  return the_last;
}

/// Samples of one batch.
constexpr std::size_t kBatch = 4096;

using Clock = std::chrono::steady_clock;

double nanoseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// Calls draw(first) for every kBatch points of a stream, or of the pool, on and on.
template <class Draw>
void time_batches(benchmark::State& state, const Draw& draw) {
  std::uint64_t first = 0;
  for (int warm = 0; warm < 4; ++warm, first += kBatch) draw(first);
  const auto start = Clock::now();
  for (auto _ : state) {
    draw(first);
    first += kBatch;
  }
  const double samples = static_cast<double>(state.iterations()) * static_cast<double>(kBatch);
  state.counters["ns_per_sample"] = nanoseconds_since(start) / samples;
  state.SetItemsProcessed(static_cast<std::int64_t>(samples));
}

template <class Sampler>
void time_random(benchmark::State& state, const Sampler& sampler) {
  const std::span<const SquarePoint> points = random_points();
  for (std::size_t i = 0; i < 256; ++i) benchmark::DoNotOptimize(sampler.sample(points[i]));
  std::size_t next = 0;
  const auto start = Clock::now();
  for (auto _ : state) {
    const TexelSample sample = sampler.sample(points[next]);
    benchmark::DoNotOptimize(sample);
    next = (next + 1) % kPoints;
  }
  state.counters["ns_per_sample"] =
      nanoseconds_since(start) / static_cast<double>(state.iterations());
  state.SetItemsProcessed(state.iterations());
}

template <class Sampler>
void time_batch(benchmark::State& state, const Sampler& sampler) {
  std::vector<TexelSample> samples(kBatch);
  time_batches(state, [&](std::uint64_t first) {
    sample(sampler, random_points().subspan(first % kPoints, kBatch), samples);
    benchmark::DoNotOptimize(samples.data());
    benchmark::ClobberMemory();
  });
}

const RandomStream& fused_stream() {
  static const RandomStream stream("bench/fused", 1);
  return stream;
}

/// What speed is compared with, of the last size that was asked for.
struct Yardsticks {
  explicit Yardsticks(Extent extent) : baseline(map_of(extent)), limit(extent) {}

  UpperBoundBaseline baseline;
  BareGather limit;
};

const Yardsticks& yardsticks_of(Extent extent) {
  static std::unique_ptr<Yardsticks> the_last;
  static Extent size;
  if (!the_last || !(size == extent)) {
    the_last.reset();
    the_last = std::make_unique<Yardsticks>(extent);
    size = extent;
  }
  return *the_last;
}

/// Median of five slices of 5 ms.
template <class Draw>
double ns_per_sample(const Draw& draw) {
  static std::uint64_t first = 0;
  std::array<double, 5> slices;
  draw(first);
  for (double& slice : slices) {
    const auto start = Clock::now();
    double samples = 0.0;
    do {
      draw(first += kBatch);
      samples += kBatch;
    } while (nanoseconds_since(start) < 5e6);
    slice = nanoseconds_since(start) / samples;
  }
  std::ranges::nth_element(slices, slices.begin() + 2);
  return slices[2];
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
  const Yardsticks& yardsticks = yardsticks_of(extent);
  std::vector<TexelSample> samples(kBatch);
  auto baseline = draw_baseline(yardsticks.baseline);
  const double before[] = {ns_per_sample(std::ref(baseline)),
                           ns_per_sample(draw_limit(yardsticks.limit))};
  time_batches(state, [&](std::uint64_t first) {
    sample(sampler, fused_stream(), first, samples);
    benchmark::DoNotOptimize(samples.data());
    benchmark::ClobberMemory();
  });
  // On either side of the sampler's time, so that a change of the machine's speed cancels.
  const double base = 0.5 * (before[0] + ns_per_sample(std::ref(baseline)));
  const double limit = 0.5 * (before[1] + ns_per_sample(draw_limit(yardsticks.limit)));
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
  const Prepared& subject = prepared(info, extent);
  if (!subject.why_not.empty()) return disagree(state, subject.why_not);
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
      *subject.sampler);
  state.counters["build_ms"] = subject.build_ms;
  if (draws_texels(info)) state.counters["worst_texel_error"] = subject.worst_texel_error;
}

void baseline_benchmark(benchmark::State& state, Extent extent) {
  const UpperBoundBaseline& baseline = yardsticks_of(extent).baseline;
  auto draw = draw_baseline(baseline);
  time_batches(state, std::ref(draw));
  set_table_counters(state, baseline.table_bytes(), extent);
  const Grid<double>& masses = law_of(extent, {kWeighting, kRec709}).masses;
  state.counters["worst_texel_error"] = worst_texel_error(baseline, masses);
}

void limit_benchmark(benchmark::State& state, Extent extent) {
  const BareGather& limit = yardsticks_of(extent).limit;
  time_batches(state, draw_limit(limit));
  set_table_counters(state, limit.table_bytes(), extent);
}

struct OrderInfo {
  Order order;
  std::string_view name;
};
constexpr std::array<OrderInfo, 3> kOrders = {
    {{Order::random, "random"}, {Order::batch, "batch"}, {Order::fused, "fused"}}};

struct YardstickInfo {
  std::string_view name;
  void (*run)(benchmark::State&, Extent);
};
constexpr std::array<YardstickInfo, 2> kYardsticks = {
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
    for (const YardstickInfo& yardstick : kYardsticks) {
      const std::string name = name_of(yardstick.name, extent, "fused");
      benchmark::RegisterBenchmark(name.c_str(), [&yardstick, extent](benchmark::State& state) {
        yardstick.run(state, extent);
      });
    }
    register_samplers(extent, kOrders);
    if (extent == kExtents.back()) continue;
    register_samplers(half_as_large_again(extent), std::span(kOrders).first<1>());
  }
}

}  // namespace lightproof::bench
