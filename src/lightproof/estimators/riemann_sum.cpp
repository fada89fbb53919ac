#include "lightproof/estimators/riemann_sum.h"

#include <algorithm>
#include <cmath>

#include "lightproof/estimators/light_samples.h"

namespace lightproof {
namespace {

/// The directions of a Riemann sum around +z, ring by ring.
class Rings {
 public:
  explicit Rings(RiemannSteps steps)
      : steps_(steps), step_(0.5 * kPi / static_cast<double>(steps.polar)) {}

  std::uint64_t count() const { return steps_.azimuths * steps_.polar; }
  /// The direction of this number, and the solid angle by which it is weighted: the ring's
  /// cosine-weighted area, 2 pi sin(theta) cos(theta) sin(step), over the cosine and the azimuths.
  Direction direction(std::uint64_t index, double& solid_angle) const {
    const std::uint64_t ring = index / steps_.azimuths;
    const double theta = (static_cast<double>(ring) + 0.5) * step_;
    const double phi = 2.0 * kPi * (static_cast<double>(index % steps_.azimuths) + 0.5) /
                       static_cast<double>(steps_.azimuths);
    const double sine = std::sin(theta);
    solid_angle = 2.0 * kPi / static_cast<double>(steps_.azimuths) * sine * std::sin(step_);
    return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
  }

 private:
  RiemannSteps steps_;
  double step_;
};

Rgb sum_of(const EnvironmentMap& map, const Scene& scene, const Material& material,
           const ShadingPoint& at, RiemannSteps steps) {
  const Rings rings(steps);
  LightSamples samples;
  Arrivals arrivals;
  glm::dvec3 sum(0.0);
  for (std::uint64_t done = 0; done < rings.count(); done += LightSamples::kCapacity) {
    samples.count = std::min<std::uint64_t>(rings.count() - done, LightSamples::kCapacity);
    for (std::size_t i = 0; i < samples.count; ++i) {
      double solid_angle = 0.0;
      samples.set(i, at.frame.to_world(rings.direction(done + i, solid_angle)));
      samples.pdf[i] = 1.0 / solid_angle;
    }
    samples.locate(map.radiance.extent());
    samples.reflect(material, at);
    for (const Rgb rgb : samples.estimates(scene, map.radiance, at.position, arrivals)) {
      sum += glm::dvec3(rgb);
    }
  }
  return Rgb(sum);
}

}  // namespace

RiemannSteps riemann_steps(std::uint64_t samples) {
  auto polar = static_cast<std::uint64_t>(std::sqrt(0.5 * static_cast<double>(samples)));
  polar = std::max<std::uint64_t>(polar, 1);
  return {samples / polar, polar};
}

PreparedEstimator riemann_sum(const EnvironmentMap& map) {
  return {[&map](const Scene& scene, const Material& material) -> BoundEstimator {
    return {[&map, &scene, material](const ShadingPoint& at, const RandomStream& /*stream*/,
                                     Budget budget, const EachEstimate& /*each*/) {
      return sum_of(map, scene, material, at, riemann_steps(budget.samples));
    }};
  }};
}

}  // namespace lightproof
