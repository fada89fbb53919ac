#include "lightproof/estimators/point_set.h"

#include <algorithm>
#include <array>

#include "lightproof/points/random_words.h"
#include "lightproof/points/registry.h"
#include "lightproof/render/direct_lighting.h"

namespace lightproof {
namespace {

Rgb mean_over(const Lighting& lighting, const ShadingPoint& at, const AnyPointSet& set,
              std::uint64_t samples) {
  LightBatch batch;
  std::array<SquarePoint, LightBatch::kCapacity> points;
  glm::dvec3 sum(0.0);
  for (std::uint64_t done = 0; done < samples; done += points.size()) {
    const std::span<SquarePoint> some =
        std::span(points).first(std::min<std::uint64_t>(samples - done, points.size()));
    fill_points(set, done, some);
    for (const Rgb estimate : batch.estimate(lighting, at, BatchPoints(some), some.size())) {
      sum += glm::dvec3(estimate);
    }
  }
  return Rgb(sum / static_cast<double>(samples));
}

}  // namespace

PreparedEstimator prepare_point_set(const EnvironmentMap& map, DirectionSource source,
                                    std::string_view point_set) {
  const PointSetInfo& info = point_set_by_name(point_set);
  const auto light = std::make_shared<const EnvironmentLight>(map, source);
  return {[light, &info](const Scene& scene, const Material& material) -> BoundEstimator {
            return {[lighting = Lighting{&scene, light.get(), material}, light, &info](
                        const ShadingPoint& at, const RandomStream& stream, Budget budget,
                        const EachEstimate& /*each*/) {
              const AnyPointSet set = info.prepare(budget.samples, seed_from(stream, budget.first));
              return mean_over(lighting, at, set, budget.samples);
            }};
          },
          light->table_bytes()};
}

}  // namespace lightproof
