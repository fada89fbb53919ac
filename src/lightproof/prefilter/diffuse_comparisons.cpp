#include "lightproof/prefilter/diffuse_comparisons.h"

#include "lightproof/prefilter/diffuse_shading.h"
#include "lightproof/prefilter/sampled_irradiance.h"

namespace lightproof {
namespace {

constexpr Direction kNormal = {0.0, 0.0, 1.0};

glm::dvec3 white_light(Direction /*direction*/) { return glm::dvec3(1.0); }

EnvironmentMap white_map() { return {"white", Grid<Rgb>({2, 2}, Rgb(1.0F))}; }

/// Middles of equal steps: the mean of anything linear in u.t is exact.
std::vector<SquarePoint> middles() {
  constexpr int kCount = 64;
  std::vector<SquarePoint> points;
  for (int i = 0; i < kCount; ++i) points.push_back({0.5, (i + 0.5) / kCount});
  return points;
}

}  // namespace

PublishedComparison riemann_comparison(RiemannRule rule) {
  const bool midpoint = rule.nodes == RiemannNodes::midpoint;
  return {"002-2",
          midpoint ? "Riemann sum of constant light, nodes in the middle of their steps"
                   : "Riemann sum of constant light, nodes at the end of their steps",
          1.0, riemann_reflection_published(white_light, kNormal, rule).rgb.r,
          riemann_reflection(white_light, kNormal, rule).rgb.r};
}

PublishedComparison diffuse_factor_comparison() {
  const Irradiance white = irradiance(white_map(), kNormal);
  const glm::dvec3 colour(1.0);
  return {"004-2", "factor of the diffuse term, c pi against c / pi, constant light", 1.0,
          diffuse_reflection_published(white, colour).rgb.r,
          diffuse_reflection(white, colour).rgb.r};
}

PublishedComparison hemisphere_comparison() {
  const EnvironmentMap map = white_map();
  return {"004-2", "hemisphere of the diffuse integral, opposite the normal or around it", kPi,
          opposite_hemisphere_published(map, kNormal).rgb.r, irradiance(map, kNormal).rgb.r};
}

PublishedComparison uniform_density_comparison() {
  const std::vector<SquarePoint> points = middles();
  return {"004-2", "density of uniform directions, 2 pi against 1 / 2 pi, constant light", kPi,
          uniform_sampled_irradiance_published(white_light, kNormal, points).rgb.r,
          uniform_sampled_irradiance(white_light, kNormal, points).rgb.r};
}

PublishedComparison transmittance_comparison(double f0) {
  const double exact = (1.0 - f0) * 20.0 / 21.0;
  return {"004-3", "light that enters under a Fresnel coat, 1 - F taken as 1", exact,
          mean_transmittance_published(f0), mean_transmittance(f0)};
}

std::vector<PublishedComparison> diffuse_comparisons() {
  constexpr int kSteps = 10;
  return {riemann_comparison({4 * kSteps, kSteps, RiemannNodes::midpoint}),
          riemann_comparison({4 * kSteps, kSteps, RiemannNodes::endpoint}),
          diffuse_factor_comparison(),
          hemisphere_comparison(),
          uniform_density_comparison(),
          transmittance_comparison(0.04)};
}

}  // namespace lightproof
