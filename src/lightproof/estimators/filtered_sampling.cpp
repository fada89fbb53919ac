#include "lightproof/estimators/filtered_sampling.h"

#include <algorithm>
#include <cmath>

#include "lightproof/estimators/light_samples.h"
#include "lightproof/points/hammersley.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/registry.h"
#include "lightproof/prefilter/mip_pyramid.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Steradian of a texel at this distance from the axis; at the poles that of a row's middle.
double texel_at(Extent extent, double sine) {
  const double least_sine = std::sin(0.5 * kPi / extent.height);
  return 2.0 * kPi * kPi / static_cast<double>(extent.count()) * std::max(least_sine, sine);
}

/// The bytes of all levels below the map itself: a third of the map's.
std::size_t bytes_below(Extent extent) {
  std::size_t bytes = 0;
  while (extent.count() > 1) {
    extent = {std::max(1, extent.width / 2), std::max(1, extent.height / 2)};
    bytes += extent.count() * sizeof(Rgb);
  }
  return bytes;
}

/// Looks the light of every sample up in the level that its density asks for.
void look_up(const MipPyramid& pyramid, std::uint64_t drawn, LightSamples& samples) {
  samples.has_light = true;
  for (std::size_t i = 0; i < samples.count; ++i) {
    samples.light[i] = Rgb(0.0F);
    if (!(samples.pdf[i] > 0.0 && samples.reflected_cosine[i] > 0.0)) continue;
    const Direction light = samples.direction(i);
    const double texel = texel_at(pyramid.base().extent(), std::hypot(light.x, light.y));
    const double texels = 1.0 / (static_cast<double>(drawn) * samples.pdf[i] * texel);
    const double level = 0.5 * std::log2(std::max(1.0, texels));
    samples.light[i] = Rgb(pyramid.trilinear(approximate_square_from_direction(light), level));
  }
}

Rgb mean_of(const MipPyramid& pyramid, const Scene& scene, const Material& material,
            const ShadingPoint& at, const Hammersley& set, std::uint64_t count) {
  LightSamples samples;
  Arrivals arrivals;
  std::array<double, LightSamples::kCapacity> s;
  std::array<double, LightSamples::kCapacity> t;
  glm::dvec3 sum(0.0);
  for (std::uint64_t done = 0; done < count; done += LightSamples::kCapacity) {
    const std::size_t some = std::min<std::uint64_t>(count - done, LightSamples::kCapacity);
    for (std::size_t i = 0; i < some; ++i) {
      const SquarePoint point = set.point(static_cast<std::uint32_t>(done + i));
      s[i] = point.s;
      t[i] = point.t;
    }
    samples.count = some;
    sample_material(material, at, std::span(s).first(some), std::span(t).first(some),
                    {std::span(samples.x).first(some), std::span(samples.y).first(some),
                     std::span(samples.z).first(some), std::span(samples.pdf).first(some),
                     std::span(samples.reflected_cosine).first(some)});
    look_up(pyramid, count, samples);
    for (const Rgb rgb : samples.estimates(scene, pyramid.base(), at.position, arrivals)) {
      sum += glm::dvec3(rgb);
    }
  }
  return Rgb(sum / static_cast<double>(count));
}

}  // namespace

PreparedEstimator filtered_sampling(const EnvironmentMap& map) {
  const auto pyramid = std::make_shared<const MipPyramid>(map.radiance);
  return {[pyramid](const Scene& scene, const Material& material) -> BoundEstimator {
            return {[pyramid, &scene, material](const ShadingPoint& at, const RandomStream& stream,
                                                Budget budget, const EachEstimate& /*each*/) {
              const Hammersley set(budget.samples, 0, seed_from(stream, budget.first));
              return mean_of(*pyramid, scene, material, at, set, budget.samples);
            }};
          },
          bytes_below(map.radiance.extent())};
}

}  // namespace lightproof
