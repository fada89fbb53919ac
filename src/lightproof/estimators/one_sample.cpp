#include "lightproof/estimators/one_sample.h"

#include <algorithm>
#include <utility>

#include "lightproof/render/direct_lighting.h"

namespace lightproof {
namespace {

Rgb mean_of(const Lighting& lighting, const ShadingPoint& at, const RandomStream& stream,
            Budget budget, const EachEstimate& each) {
  LightBatch batch;
  glm::dvec3 sum(0.0);
  for (std::uint64_t done = 0; done < budget.samples; done += LightBatch::kCapacity) {
    const auto count = std::min<std::uint64_t>(budget.samples - done, LightBatch::kCapacity);
    const std::span<const Rgb> estimates =
        batch.estimate(lighting, at, {stream, budget.first + done}, count);
    for (const Rgb estimate : estimates) sum += glm::dvec3(estimate);
    if (each) each(estimates);
  }
  return Rgb(sum / static_cast<double>(budget.samples));
}

}  // namespace

PreparedEstimator prepare_one_sample(const EnvironmentMap& map, DirectionSource source) {
  const auto light = std::make_shared<const EnvironmentLight>(map, source);
  return {[light](const Scene& scene, const Material& material) -> BoundEstimator {
            return {[lighting = Lighting{&scene, light.get(), material}, light](
                        const ShadingPoint& at, const RandomStream& stream, Budget budget,
                        const EachEstimate& each) {
              return mean_of(lighting, at, stream, budget, each);
            }};
          },
          light->table_bytes()};
}

}  // namespace lightproof
