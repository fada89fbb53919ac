#include "lightproof/shading/layered_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/moments.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/direct_lighting.h"
#include "lightproof/render/receiver.h"
#include "reference/microfacet_reflectance.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kSamples = 30000;
/// Of standard errors: a claim of this file fails by chance in 1 of 10^5 runs of it.
constexpr double kErrors = 5.0;

ShadingPoint seen_at(double cosine) {
  return {glm::dvec3(0.0),
          frame_around({0.0, 0.0, 1.0}),
          {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}};
}

TEST(LayeredLight, OfAWhiteSkyIsWhatTheCoatReflects) {
  const EnvironmentMap white = make_synthetic_map("constant", {64, 32});
  const Scene scene({false, false});
  const LayeredLight light(white, scene);
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const glm::dvec3 f0 = {0.04, 0.5, 1.0};
    const LayeredSurface surface = {Ggx{0.5, 0.0}, f0, glm::dvec3(0.0)};
    const LayeredEstimate estimate =
        light.reflected(surface, seen_at(cosine), RandomStream("white", 1), kSamples);
    const reference::SplitSum exact =
        reference::split_sum({{reference::NormalDistribution::Kind::ggx, 0.25},
                              reference::Masking::smith_height_correlated},
                             cosine);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(estimate.radiance[channel], exact.of(f0[channel]),
                  kErrors * estimate.standard_error[channel]);
    }
  }
}

TEST(LayeredLight, GivesTheBaseWhatTheCoatLeaves) {
  const EnvironmentMap white = make_synthetic_map("constant", {64, 32});
  const Scene scene({false, false});
  const LayeredLight light(white, scene);
  const auto with_base = [&](BaseShare share) {
    const LayeredSurface both = {Ggx{0.5, 0.0}, glm::dvec3(0.04), glm::dvec3(0.8), share};
    return light.reflected(both, seen_at(0.5), RandomStream("base", 1), kSamples);
  };
  const double coat = reference::split_sum({{reference::NormalDistribution::Kind::ggx, 0.25},
                                            reference::Masking::smith_height_correlated},
                                           0.5)
                          .of(0.04);
  const LayeredEstimate of_view = with_base(BaseShare::of_view);
  EXPECT_NEAR(of_view.radiance.r, coat + 0.8 * (1.0 - (0.04 + 0.96 / 32.0)),
              kErrors * of_view.standard_error.r);
  const LayeredEstimate of_light = with_base(BaseShare::of_light);
  EXPECT_NEAR(of_light.radiance.r, coat + 0.8 * 0.96 * 20.0 / 21.0,
              kErrors * of_light.standard_error.r);
}

/// The light that a material reflects by the integrator of all renders.
LayeredEstimate by_light_batch(const EnvironmentMap& map, const Scene& scene,
                               const Material& material, const ShadingPoint& at) {
  const EnvironmentLight light(map, MapDensity{DensitySpace::solid_angle});
  LightBatch batch;
  const RandomStream stream("batch", 2);
  Moments red;
  for (std::uint64_t first = 0; first < kSamples; first += LightBatch::kCapacity) {
    for (const Rgb rgb :
         batch.estimate({&scene, &light, material}, at, {stream, first}, LightBatch::kCapacity)) {
      red.add(static_cast<double>(rgb.r));
    }
  }
  return {glm::dvec3(red.mean()),
          glm::dvec3(std::sqrt(red.variance() / static_cast<double>(red.count())))};
}

TEST(LayeredLight, IsThatOfTheIntegratorOfRenders) {
  const Scene scene({true, true});
  // On the plane, beside the sphere, which blocks a part of the sky.
  const ShadingPoint at = {{1.3, 0.2, -1.0 + kSurfaceOffset},
                           frame_around({0.0, 0.0, 1.0}),
                           glm::normalize(Direction(0.5, -1.0, 0.7))};
  for (const char* name : {"sun-sky", "gradient"}) {
    const EnvironmentMap map = make_synthetic_map(name, {64, 32});
    const LayeredLight light(map, scene);
    const auto agree = [&](const LayeredSurface& surface, const Material& material) {
      const LayeredEstimate one =
          light.reflected(surface, at, RandomStream("layered", 1), kSamples);
      const LayeredEstimate other = by_light_batch(map, scene, material, at);
      EXPECT_NEAR(one.radiance.r, other.radiance.r,
                  kErrors * std::hypot(one.standard_error.r, other.standard_error.r))
          << name;
    };
    agree({Ggx{0.6, 0.0}, glm::dvec3(0.3), glm::dvec3(0.0)}, Ggx{0.6, 0.3});
    agree({BlinnMicrofacet{0.6, 0.0}, glm::dvec3(0.3), glm::dvec3(0.0)}, BlinnMicrofacet{0.6, 0.3});
  }
}

TEST(LayeredLight, FindsASmallSun) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {512, 256});
  const Scene scene({false, false});
  const LayeredSurface surface = {Ggx{0.3, 0.0}, glm::dvec3(0.04), glm::dvec3(0.8)};
  const LayeredEstimate estimate =
      LayeredLight(map, scene).reflected(surface, seen_at(0.8), RandomStream("sun", 1), 3000);
  EXPECT_LT(estimate.standard_error.r, 0.03 * estimate.radiance.r);
}

}  // namespace
}  // namespace lightproof
