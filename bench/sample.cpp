// Time to draw one sample: sample/<sampler>/<map>/<W>x<H>/random.
//
// Random points are generated beforehand, so many that the parts of a table that they reach do not
// stay in the cache; the sampler's type is static inside the loop. Before a sampler is timed, its
// samples must fit the bins of reference/, and if it searches sums, its texels must be those of
// reference/.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "bench/registration.h"
#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/suite/draws.h"
#include "reference/slow_sampler.h"
#include "reference/texel_masses.h"

namespace lightproof::bench {
namespace {

constexpr std::string_view kMap = "sun-sky";
constexpr std::array<Extent, 5> kExtents = {
    {{512, 256}, {1024, 512}, {2048, 1024}, {4096, 2048}, {8192, 4096}}};
constexpr std::size_t kPoints = std::size_t{1} << 21U;
constexpr std::size_t kFitted = std::size_t{1} << 16U;
/// Far beyond chance: the points are the same in every run.
constexpr double kLeastLog10P = -6.0;
/// The lecture's weighting.
constexpr Weighting kWeighting = Weighting::A;

bool disagreed = false;

/// Benchmarks of one size follow each other, so one map at a time is enough.
const EnvironmentMap& map_of(Extent extent) {
  static EnvironmentMap map;
  if (!(map.radiance.extent() == extent)) {
    map = {};
    map = make_synthetic_map(kMap, extent);
  }
  return map;
}

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

/// Of the law that all samplers of this target draw.
const std::vector<double>& bins_of(Extent extent, TargetDensity target) {
  static std::vector<double> bins;
  static Extent made_for;
  static TargetDensity made_with = {};
  if (!(made_for == extent) || !(made_with == target)) {
    bins = serpentine(reference::bin_masses(map_of(extent), target, kGateBins));
    made_for = extent;
    made_with = target;
  }
  return bins;
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
      cressie_read(serpentine(counts), bins_of(extent, info.target(kWeighting)), count).log10_p;
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

/// A sampler that was built and checked: once, though Google Benchmark runs a benchmark several
/// times.
struct Prepared {
  std::optional<AnySampler> sampler;
  double build_ms = 0.0;
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
      },
      *the_last.sampler);
  name = info.name;
  size = extent;
  return the_last;
}

template <class Sampler>
void time_sampler(benchmark::State& state, const Sampler& sampler) {
  const std::span<const SquarePoint> points = random_points();
  for (std::size_t i = 0; i < 256; ++i) benchmark::DoNotOptimize(sampler.sample(points[i]));
  std::size_t next = 0;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) {
    const TexelSample sample = sampler.sample(points[next]);
    benchmark::DoNotOptimize(sample);
    next = (next + 1) % kPoints;
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  state.SetItemsProcessed(state.iterations());
  state.counters["ns_per_sample"] = elapsed.count() / static_cast<double>(state.iterations());
  state.counters["table_bytes"] = static_cast<double>(sampler.table_bytes());
}

void sample_benchmark(benchmark::State& state, const SamplerInfo& info, Extent extent) {
  const Prepared& subject = prepared(info, extent);
  if (!subject.why_not.empty()) return disagree(state, subject.why_not);
  std::visit([&](const auto& sampler) { time_sampler(state, sampler); }, *subject.sampler);
  state.counters["build_ms"] = subject.build_ms;
}

}  // namespace

void disagree(benchmark::State& state, const std::string& why) {
  disagreed = true;
  state.SkipWithError(why.c_str());
}

bool any_disagreement() { return disagreed; }

void register_sample_benchmarks() {
  for (const Extent extent : kExtents) {
    for (const SamplerInfo& info : samplers()) {
      const std::string name =
          fmt::format("sample/{}/{}/{}x{}/random", info.name, kMap, extent.width, extent.height);
      benchmark::RegisterBenchmark(name.c_str(), [&info, extent](benchmark::State& state) {
        sample_benchmark(state, info, extent);
      });
    }
  }
}

}  // namespace lightproof::bench
