#include "lightproof/estimators/light_samples.h"

#include "lightproof/warp/sphere_batch.h"

namespace lightproof {

void LightSamples::locate(Extent map) {
  std::array<double, kCapacity> s;
  std::array<double, kCapacity> t;
  const DirectionArrays all = directions();
  approximate_positions(all.x, all.y, all.z,
                        {std::span(s).first(count), std::span(t).first(count)});
  for (std::size_t i = 0; i < count; ++i) {
    column[i] = cell_of(s[i], map.width);
    row[i] = cell_of(t[i], map.height);
  }
}

std::span<const Rgb> LightSamples::estimates(const Scene& scene, const Grid<Rgb>& radiance,
                                             glm::dvec3 position, Arrivals& arrivals) const {
  const auto width = static_cast<std::size_t>(radiance.extent().width);
  arrivals.begin(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb* texel = has_light
                           ? &light[i]
                           : radiance.values().data() + static_cast<std::size_t>(row[i]) * width +
                                 static_cast<std::size_t>(column[i]);
    arrivals.add(i, position, direction(i), texel, static_cast<float>(reflected_cosine[i] / pdf[i]),
                 reflected_cosine[i] > 0.0 && pdf[i] > 0.0);
  }
  arrivals.trace(scene);
  return arrivals.resolve();
}

}  // namespace lightproof
