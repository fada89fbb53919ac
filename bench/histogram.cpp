// Time to count one direction into the gate's bins, one thread: histogram/<warp>/<phase>.
//
//   count           directions drawn beforehand, in a block that fits the second-level cache
//   count_and_test  2^26 of them, then the p-value against the distribution's exact bin masses. The
//   block is
//                   counted over and over, so that the p-value itself says nothing.
//   draw_and_count  random numbers and warp as well, through the registry's erased type
//
// Before anything is timed, the counts of the block must be those of the scalar definition, and
// must fit the distribution.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/registration.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/direction_histogram.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof::bench {
namespace {

/// The widest distribution, the lecture's, and one whose samples all fall into the row of the pole.
constexpr std::array<std::string_view, 3> kWarps = {"uniform_hemisphere", "cosine_hemisphere",
                                                    "phong_lobe_1000"};
constexpr std::size_t kBlock = std::size_t{1} << 14U;
constexpr std::size_t kTested = std::size_t{1} << 26U;
/// Far beyond chance: the points are the same in every run.
constexpr double kLeastLog10P = -6.0;

/// Directions of one warp, and the exact masses of the bins, in the order of `serpentine`.
class Block {
 public:
  explicit Block(const DirectionSamplerInfo& sampler)
      : sampler_(sampler),
        masses_(serpentine(bin_masses(std::get<CosineLobes>(sampler.distribution)))) {
    draw(0);
  }

  /// Points [first, first + kBlock) of the stream.
  void draw(std::uint64_t first) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      const Direction d = sampler_.sample(stream_.point(first + i)).direction;
      x_[i] = d.x;
      y_[i] = d.y;
      z_[i] = d.z;
    }
  }

  DirectionArrays directions() const { return {x_, y_, z_}; }

  double log10_p(const DirectionHistogram& histogram) const {
    return cressie_read(serpentine(histogram.bins()), masses_, histogram.samples()).log10_p;
  }

  /// An explanation if the counts are wrong; empty if not.
  std::string disagreement() const {
    DirectionHistogram histogram;
    histogram.add(directions());
    const Grid<std::uint64_t> bins = histogram.bins();
    if (!std::ranges::equal(bins.values(), scalar_bins().values())) {
      return "the counts are not those of square_from_direction";
    }
    const double p = log10_p(histogram);
    return p > kLeastLog10P
               ? ""
               : fmt::format("the counts do not fit the distribution: log10 p = {}", p);
  }

 private:
  static Grid<double> bin_masses(std::span<const reference::CosineLobe> distribution) {
    const Grid<double> cells =
        reference::cell_masses(distribution, reference::cells_for(distribution));
    return reference::bin_masses(cells, DensitySpace::solid_angle, kGateBins);
  }

  Grid<std::uint64_t> scalar_bins() const {
    Grid<std::uint64_t> bins(kGateBins);
    for (std::size_t i = 0; i < kBlock; ++i) {
      const SquarePoint at = square_from_direction({x_[i], y_[i], z_[i]});
      ++bins(cell_of(at.s, kGateBins.width), cell_of(at.t, kGateBins.height));
    }
    return bins;
  }

  DirectionSamplerInfo sampler_;
  RandomStream stream_{"bench/histogram", 1};
  std::vector<double> masses_;
  std::vector<double> x_ = std::vector<double>(kBlock);
  std::vector<double> y_ = x_;
  std::vector<double> z_ = x_;
};

void count(Block& block, benchmark::State& state) {
  DirectionHistogram histogram;
  for (auto _ : state) {
    histogram.add(block.directions());
    benchmark::ClobberMemory();
  }
  benchmark::DoNotOptimize(histogram.bins());
}

void count_and_test(Block& block, benchmark::State& state) {
  for (auto _ : state) {
    DirectionHistogram histogram;
    for (std::size_t done = 0; done < kTested; done += kBlock) histogram.add(block.directions());
    benchmark::DoNotOptimize(block.log10_p(histogram));
  }
}

void draw_and_count(Block& block, benchmark::State& state) {
  DirectionHistogram histogram;
  std::uint64_t first = 0;
  for (auto _ : state) {
    block.draw(first += kBlock);
    histogram.add(block.directions());
  }
  benchmark::DoNotOptimize(histogram.bins());
}

struct Phase {
  std::string_view name;
  void (*run)(Block&, benchmark::State&);
  std::size_t samples;  ///< of one iteration
};
constexpr Phase kPhases[] = {
    {"count", count, kBlock},
    {"count_and_test", count_and_test, kTested},
    {"draw_and_count", draw_and_count, kBlock},
};

const DirectionSamplerInfo& warp_by_name(std::string_view name) {
  static const std::vector<DirectionSamplerInfo> samplers = direction_samplers();
  const auto found = std::ranges::find(samplers, name, &DirectionSamplerInfo::name);
  if (found == samplers.end()) throw std::logic_error(fmt::format("no warp \"{}\"", name));
  return *found;
}

void histogram_benchmark(benchmark::State& state, const DirectionSamplerInfo& warp,
                         const Phase& phase) {
  Block block(warp);
  if (const std::string why = block.disagreement(); !why.empty()) return disagree(state, why);
  phase.run(block, state);
  const double samples =
      static_cast<double>(state.iterations()) * static_cast<double>(phase.samples);
  using benchmark::Counter;
  state.counters["samples_per_second"] = Counter(samples, Counter::kIsRate);
  state.counters["ns_per_sample"] = Counter(1e-9 * samples, Counter::kIsRate | Counter::kInvert);
}

}  // namespace

void register_histogram_benchmarks() {
  for (const std::string_view warp : kWarps) {
    for (const Phase& phase : kPhases) {
      const std::string name = fmt::format("histogram/{}/{}", warp, phase.name);
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&info = warp_by_name(warp), &phase](benchmark::State& state) {
                                     histogram_benchmark(state, info, phase);
                                   });
    }
  }
}

}  // namespace lightproof::bench
