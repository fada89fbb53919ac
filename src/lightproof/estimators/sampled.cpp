#include "lightproof/estimators/sampled.h"

#include <algorithm>
#include <array>

#include "lightproof/points/random_words.h"
#include "lightproof/points/registry.h"

namespace lightproof {
namespace {

/// A source that is ready for a scene and a material.
struct BoundSource {
  const EnvironmentMap* map;
  const Scene* scene;
  SamplesAt at;

  /// Calls use(estimates) for all samples, a batch at a time; points_of(first, count) gives the
  /// points of a batch.
  template <class PointsOf, class Use>
  void visit(const ShadingPoint& point, std::uint64_t samples, const PointsOf& points_of,
             const Use& use) const {
    const DrawSamples draw = at(point);
    LightSamples batch;
    Arrivals arrivals;
    for (std::uint64_t done = 0; done < samples; done += LightSamples::kCapacity) {
      batch.count = std::min<std::uint64_t>(samples - done, LightSamples::kCapacity);
      draw(points_of(done, batch.count), batch);
      use(batch.estimates(*scene, map->radiance, point.position, arrivals));
    }
  }
};

/// A sum in double, and how many were added.
class Mean {
 public:
  void add(std::span<const Rgb> estimates) {
    for (const Rgb estimate : estimates) sum_ += glm::dvec3(estimate);
  }
  Rgb over(std::uint64_t samples) const { return Rgb(sum_ / static_cast<double>(samples)); }

 private:
  glm::dvec3 sum_ = glm::dvec3(0.0);
};

}  // namespace

PreparedEstimator independent_samples(PreparedSource source) {
  return {[source](const Scene& scene, const Material& material) -> BoundEstimator {
            const BoundSource bound = {source.map, &scene, source.bind(material)};
            return {[bound](const ShadingPoint& at, const RandomStream& stream, Budget budget,
                            const EachEstimate& each) {
              Mean mean;
              bound.visit(
                  at, budget.samples,
                  [&](std::uint64_t done, std::size_t /*count*/) {
                    return BatchPoints(stream, budget.first + done);
                  },
                  [&](std::span<const Rgb> estimates) {
                    mean.add(estimates);
                    if (each) each(estimates);
                  });
              return mean.over(budget.samples);
            }};
          },
          source.bytes};
}

PreparedEstimator samples_at_points(PreparedSource source, std::string_view point_set) {
  const PointSetInfo& info = point_set_by_name(point_set);
  return {[source, &info](const Scene& scene, const Material& material) -> BoundEstimator {
            const BoundSource bound = {source.map, &scene, source.bind(material)};
            return {[bound, &info](const ShadingPoint& at, const RandomStream& stream,
                                   Budget budget, const EachEstimate& /*each*/) {
              const AnyPointSet set = info.prepare(budget.samples, seed_from(stream, budget.first));
              std::array<SquarePoint, LightSamples::kCapacity> points;
              Mean mean;
              bound.visit(
                  at, budget.samples,
                  [&](std::uint64_t done, std::size_t count) {
                    const auto some = std::span(points).first(count);
                    fill_points(set, done, some);
                    return BatchPoints(some);
                  },
                  [&](std::span<const Rgb> estimates) { mean.add(estimates); });
              return mean.over(budget.samples);
            }};
          },
          source.bytes};
}

}  // namespace lightproof
