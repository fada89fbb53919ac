#include "lightproof/precompute/snapshots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/precompute/levels.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/progressive.h"
#include "lightproof/prefilter/radiance_function.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/prefilter/sampled_irradiance.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// E/pi at every normal, refined frame by frame.
class IrradianceAccumulation {
 public:
  IrradianceAccumulation(const EnvironmentMap& map, Extent extent, const RandomStream& stream)
      : radiance_(map), extent_(extent), stream_(stream), means_(extent.count()) {}

  void add_frame(int samples) {
    parallel_for(means_.size(), [&](std::size_t texel) {
      const RandomStream stream = stream_.substream(texel);
      std::vector<SquarePoint> points;
      for (int i = 0; i < samples; ++i) {
        points.push_back(stream.point(samples_ + static_cast<std::uint64_t>(i)));
      }
      const auto width = static_cast<std::size_t>(extent_.width);
      const Direction normal = normal_of_texel(extent_, static_cast<int>(texel % width),
                                               static_cast<int>(texel / width));
      means_[texel].add(cosine_sampled_reflection(radiance_, normal, points).rgb,
                        static_cast<std::uint64_t>(samples));
    });
    samples_ += static_cast<std::uint64_t>(samples);
  }

  Grid<Rgb> mean() const {
    Grid<Rgb> map(extent_);
    for (std::size_t i = 0; i < means_.size(); ++i) map.values()[i] = Rgb(means_[i].mean());
    return map;
  }

 private:
  NearestRadiance radiance_;
  Extent extent_;
  RandomStream stream_;
  std::vector<RunningMean<glm::dvec3>> means_;
  std::uint64_t samples_ = 0;
};

/// A level on its way.
struct Accumulation {
  std::function<void(int samples)> add_frame;
  std::function<Grid<Rgb>()> mean;
};

template <class Accumulating>
Accumulation shared(std::shared_ptr<Accumulating> accumulating) {
  return {[accumulating](int samples) { accumulating->add_frame(samples); },
          [accumulating] { return accumulating->mean(); }};
}

Accumulation begin(const EnvironmentMap& map, const LevelPlan& plan, std::uint64_t seed) {
  const RandomStream stream(fmt::format("snapshots/{}/{}", name_of(plan.product), plan.level),
                            seed);
  if (plan.product == Product::irradiance) {
    return shared(std::make_shared<IrradianceAccumulation>(map, plan.extent, stream));
  }
  return shared(std::make_shared<ReflectivityAccumulation>(
      map.radiance, plan.extent, *plan.roughness, ReflectivityForm::normalised, stream));
}

glm::dvec3 mean_radiance(const Grid<Rgb>& map) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < map.extent().height; ++y) {
    const double weight = texel_solid_angle(map.extent(), y) / (4.0 * kPi);
    for (const Rgb& texel : map.row(y)) sum += weight * glm::dvec3(texel);
  }
  return sum;
}

/// The error over all texels, by solid angle, relative to the mean of the map in the worst channel.
LevelError error_of(const Grid<Rgb>& made, const Grid<Rgb>& exact, const glm::dvec3& mean) {
  const Extent extent = made.extent();
  glm::dvec3 sum(0.0);
  for (int y = 0; y < extent.height; ++y) {
    const double weight = texel_solid_angle(extent, y) / (4.0 * kPi);
    for (int x = 0; x < extent.width; ++x) {
      const glm::dvec3 difference = glm::dvec3(made(x, y)) - glm::dvec3(exact(x, y));
      sum += weight * difference * difference;
    }
  }
  double worst = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    if (mean[channel] > 0.0) worst = std::max(worst, std::sqrt(sum[channel]) / mean[channel]);
  }
  return {worst, worst, worst, extent.count()};
}

/// The exact levels, row 0 at t = 0 as the accumulations have it.
std::vector<Grid<Rgb>> exact_levels(const EnvironmentMap& map, std::span<const LevelPlan> plans) {
  if (plans.front().product == Product::irradiance) {
    return {rounded(diffuse_map(irradiance_map(map, plans.front().extent)).radiance)};
  }
  std::vector<PrefilteredLevel> levels;
  for (const LevelPlan& plan : plans) levels.push_back({plan.lobe, plan.extent});
  return prefilter(map.radiance, levels);
}

class Snapshots {
 public:
  Snapshots(const EnvironmentMap& map, std::span<const LevelPlan> plans,
            const SnapshotOptions& options)
      : plans_(plans),
        options_(options),
        exact_(exact_levels(map, plans)),
        mean_(mean_radiance(map.radiance)) {
    for (const LevelPlan& plan : plans) levels_.push_back(begin(map, plan, options.seed));
  }

  std::vector<PrecomputedMap> take(const Progress& progress) {
    std::vector<PrecomputedMap> snapshots;
    for (int frame = 1, next = 1; frame <= options_.frames; ++frame) {
      for (const Accumulation& level : levels_) level.add_frame(options_.samples_per_frame);
      if (progress) progress("snapshots", static_cast<double>(frame) / options_.frames);
      if (frame != next && frame != options_.frames) continue;
      if (frame == next) next *= 2;
      snapshots.push_back(after(frame));
    }
    return snapshots;
  }

 private:
  PrecomputedMap after(int frame) const {
    const std::string_view product = name_of(plans_.front().product);
    PrecomputedMap snapshot{fmt::format("{}-frame-{}", product, frame), {Projection::lat_long, {}}};
    snapshot.map.attributes = {
        {"product", std::string(product)},
        {"method", "progressive accumulation"},
        {"samples", fmt::format("{} frames of {} a texel", frame, options_.samples_per_frame)}};
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const Grid<Rgb> mean = levels_[i].mean();
      snapshot.map.levels.push_back(lat_long_level(mean, plans_[i].roughness));
      snapshot.errors.emplace_back(error_of(mean, exact_[i], mean_));
    }
    return snapshot;
  }

  std::span<const LevelPlan> plans_;
  SnapshotOptions options_;
  std::vector<Grid<Rgb>> exact_;
  glm::dvec3 mean_;
  std::vector<Accumulation> levels_;
};

}  // namespace

std::vector<PrecomputedMap> make_snapshots(const EnvironmentMap& map,
                                           const PrecomputeRequest& request,
                                           const SnapshotOptions& options,
                                           const Progress& progress) {
  require_lat_long(map, "a map for real-time rendering");
  std::vector<PrecomputedMap> all;
  for (const ProductRequest& product : request.products) {
    if (product.product != Product::irradiance && product.product != Product::reflectivity)
      continue;
    const std::vector<LevelPlan> plans = plan_levels(product, Projection::lat_long);
    for (PrecomputedMap& snapshot : Snapshots(map, plans, options).take(progress)) {
      all.push_back(std::move(snapshot));
    }
  }
  return all;
}

}  // namespace lightproof
