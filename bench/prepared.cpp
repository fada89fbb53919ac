#include "bench/prepared.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "bench/maps.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/draws.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/median.h"
#include "lightproof/warp/lat_long.h"
#include "reference/slow_sampler.h"
#include "reference/texel_masses.h"

namespace lightproof::bench {
namespace {

constexpr std::size_t kPoints = std::size_t{1} << 21U;
constexpr std::size_t kFitted = std::size_t{1} << 16U;
/// Far beyond chance: the points are the same in every run.
constexpr double kLeastLog10P = -6.0;

const reference::SlowSampler& reference_of(Extent extent, TargetDensity target) {
  static std::unique_ptr<reference::SlowSampler> sampler;
  static Extent made_for;
  static TargetDensity made_with = {};
  if (!sampler || !(made_for == extent) || !(made_with == target)) {
    sampler.reset();
    sampler = std::make_unique<reference::SlowSampler>(map_of(extent), target);
    made_for = extent;
    made_with = target;
  }
  return *sampler;
}

std::vector<SquarePoint> make_points() {
  const RandomStream stream("bench/sample", 1);
  std::vector<SquarePoint> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) points.push_back(stream.point(i));
  return points;
}

/// The distribution that all samplers of this target draw.
struct ExactDistribution {
  Grid<double> masses;
  std::vector<double> bins;
};

const ExactDistribution& exact_distribution(Extent extent, TargetDensity target) {
  static ExactDistribution distribution;
  static Extent made_for;
  static TargetDensity made_with = {};
  if (!(made_for == extent) || !(made_with == target)) {
    distribution = {};
    distribution.masses = reference::texel_masses(map_of(extent), target);
    const bool draws_whole_texels = target.lookup == Lookup::nearest;
    distribution.bins =
        serpentine(draws_whole_texels
                       ? reference::bin_masses(distribution.masses, target.density_space, kGateBins)
                       : reference::bin_masses(map_of(extent), target, kGateBins));
    made_for = extent;
    made_with = target;
  }
  return distribution;
}

/// How far from a CDF entry of the exact distribution a sampler may take the neighbour: the
/// rounding of its own sums. Of n terms they drift by up to n steps.
double entry_tolerance(const SamplerInfo& sampler, Extent extent) {
  return (extent.width + extent.height) * sampler.resolution;
}

template <class Sampler>
std::string misfit(const Sampler& sampler, TargetDensity target, Extent extent) {
  std::vector<TexelSample> samples;
  for (const SquarePoint u : points_of_fit()) samples.push_back(sampler.sample(u));
  return misfit_of(samples, target, extent);
}

/// An explanation if a texel is not the reference's; empty if all are. The reference draws whole
/// texels: it says nothing of a look-up that interpolates.
template <class Sampler>
std::string disagreement(const Sampler& sampler, const SamplerInfo& info, Extent extent,
                         DensitySpace density_space) {
  const bool sums_texels = info.resolution != 0.0 && info.lookup == Lookup::nearest;
  if (!sums_texels) return "";
  const auto& reference = reference_of(extent, info.target(density_space));
  const double tolerance = entry_tolerance(info, extent);
  for (const SquarePoint u : random_points().first(256)) {
    const TexelSample sample = sampler.sample(u);
    if (reference::Texel{sample.x, sample.y} == reference.sample(u)) continue;
    if (reference.near_entry(u, tolerance)) continue;
    return fmt::format("u = ({:.17g}, {:.17g}): texel ({}, {}) is not the reference's", u.s, u.t,
                       sample.x, sample.y);
  }
  return "";
}

/// An explanation if a batch draws other samples than the sampler does one at a time.
template <class Sampler>
std::string other_batch(const Sampler& sampler) {
  const std::span<const SquarePoint> points = random_points().first(4099);
  std::vector<TexelSample> batch(points.size());
  sample(sampler, points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TexelSample alone = sampler.sample(points[i]);
    const double roundings = 1e-12 * alone.pdf.value;
    if (alone.x == batch[i].x && alone.y == batch[i].y &&
        std::abs(alone.pdf.value - batch[i].pdf.value) <= roundings) {
      continue;
    }
    return fmt::format(
        "u = ({:.17g}, {:.17g}): the batch draws texel ({}, {}) with pdf {:.17g}, "
        "alone ({}, {}) with {:.17g}",
        points[i].s, points[i].t, batch[i].x, batch[i].y, batch[i].pdf.value, alone.x, alone.y,
        alone.pdf.value);
  }
  return "";
}

/// Leaves the last one built. The first builds of a process are up to ten times as slow in a
/// virtual machine that has to get their memory from its host.
double median_build_ms(std::optional<AnySampler>& sampler,
                       const std::function<AnySampler()>& build) {
  constexpr std::size_t kLeast = 3;
  constexpr double kEnoughMs = 20.0;
  std::vector<double> times;
  double all = 0.0;
  while (times.size() < kLeast || all < kEnoughMs) {
    sampler.reset();  // so that there is memory for one at a time
    const auto start = std::chrono::steady_clock::now();
    sampler.emplace(build());
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count());
    all += time.count();
  }
  return median(std::move(times));
}

}  // namespace

std::span<const SquarePoint> points_of_fit() { return random_points().first(kFitted); }

std::string misfit_of(std::span<const TexelSample> samples, TargetDensity target, Extent extent) {
  Grid<std::uint64_t> counts(kGateBins);
  std::uint64_t count = 0;
  for (const TexelSample& sample : samples) {
    if (!is_on_map(sample, extent)) continue;
    ++count;
    ++counts(cell_of(sample.at.s, kGateBins.width), cell_of(sample.at.t, kGateBins.height));
  }
  const double log10_p =
      cressie_read(serpentine(counts), exact_distribution(extent, target).bins, count).log10_p;
  return log10_p > kLeastLog10P
             ? ""
             : fmt::format("the samples do not fit the map: log10 p = {}", log10_p);
}

std::span<const SquarePoint> random_points() {
  static const std::vector<SquarePoint> points = make_points();
  return points;
}

double worst_texel_error(Extent extent, TargetDensity target,
                         const std::function<double(SquarePoint)>& pdf) {
  const Grid<double>& masses = exact_distribution(extent, target).masses;
  const double texels = static_cast<double>(extent.count());
  const bool is_flat = position_measure(target.density_space) == MapMeasure::square;
  std::vector<double> worst(static_cast<std::size_t>(extent.height));
  parallel_for(worst.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) {
      if (!(masses(x, y) > 0.0)) continue;
      const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
      const double drawn = is_flat
                               ? pdf(at) / texels
                               : to_solid_angle({pdf(at)}, at).value * texel_solid_angle(extent, y);
      worst[row] = std::max(worst[row], std::abs(drawn / masses(x, y) - 1.0));
    }
  });
  return *std::ranges::max_element(worst);
}

bool draws_texels(const SamplerInfo& info) {
  return !info.known_defects && info.lookup == Lookup::nearest;
}

const Prepared& prepared(const SamplerInfo& info, Extent extent, DensitySpace density_space) {
  static Prepared the_last;
  static std::string name;
  static Extent size;
  static DensitySpace space;
  if (name == info.name && size == extent && space == density_space) return the_last;
  the_last = {};
  name.clear();
  const EnvironmentMap& map = map_of(extent);
  the_last.build_ms =
      median_build_ms(the_last.sampler, [&] { return info.make(map, density_space); });
  std::visit(
      [&](const auto& sampler) {
        the_last.why_not = misfit(sampler, info.target(density_space), extent);
        if (the_last.why_not.empty()) {
          the_last.why_not = disagreement(sampler, info, extent, density_space);
        }
        if (the_last.why_not.empty()) the_last.why_not = other_batch(sampler);
        if (!draws_texels(info)) return;
        the_last.worst_texel_error =
            worst_texel_error(extent, info.target(density_space),
                              [&](SquarePoint at) { return sampler.pdf(at).value; });
      },
      *the_last.sampler);
  name = info.name;
  size = extent;
  space = density_space;
  return the_last;
}

}  // namespace lightproof::bench
