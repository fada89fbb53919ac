#include "lightproof/shading/two_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/diffuse_shading.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/render/receiver.h"
#include "lightproof/shading/layered_light.h"
#include "lightproof/shading/shaded_pictures.h"
#include "lightproof/shading/shading_comparisons.h"

namespace lightproof {
namespace {

constexpr Extent kMap = {128, 64};

TEST(WhiteReflectivity, HasThePrintedValuesOfEachForm) {
  // S = 30 at R = (2/32)^(1/4).
  EXPECT_NEAR(white_reflectivity(0.5, TwoMapsForm::text), 1.765, 5e-4);
  EXPECT_NEAR(white_reflectivity(0.5, TwoMapsForm::program), 0.6366, 5e-5);
  EXPECT_NEAR(white_reflectivity(0.75, TwoMapsForm::program), 0.6717, 5e-5);
  EXPECT_NEAR(white_reflectivity(1.0, TwoMapsForm::program), 1.0868, 5e-5);
  EXPECT_NEAR(white_reflectivity(0.2, TwoMapsForm::corrected), 1.0, 1e-3);
}

TEST(TwoMaps, OfAWhiteSkyAreTheValuesOfTheirForm) {
  const EnvironmentMap white = make_synthetic_map("constant", kMap);
  const Direction normal = glm::normalize(Direction(1.0, -2.0, 0.5));
  const Direction view = glm::normalize(Direction(1.0, -1.0, 0.7));
  for (const TwoMapsForm form : {TwoMapsForm::text, TwoMapsForm::program, TwoMapsForm::corrected}) {
    const TwoMaps maps(white, kMap, kReflectivityLevels, form);
    for (const int level : {1, 3, 6}) {
      const GlossyOnDiffuse surface = {reflectivity_roughness(level), 0.04, {0.8, 0.4, 0.1}};
      const glm::dvec3 expected = shaded_by_white(surface, glm::dot(normal, view), form).rgb;
      const glm::dvec3 shown = maps.shaded(surface, normal, view).rgb;
      EXPECT_NEAR(shown.r, expected.r, 2e-5);
      EXPECT_NEAR(shown.b, expected.b, 2e-5);
    }
  }
}

TEST(TwoMaps, ShowTheReflectionOfTheSurfaceSeenAlongItsNormal) {
  // At n = v and F0 = 1 nothing is approximated: normals through the centres of texels, at a
  // roughness of a level.
  constexpr int kLevel = 3;
  const EnvironmentMap map = make_synthetic_map("checker", kMap);
  const TwoMaps maps(map, kMap, kReflectivityLevels, TwoMapsForm::corrected);
  const Scene scene({true, false});
  const LayeredLight light(map, scene);
  const GlossyOnDiffuse mirror = {reflectivity_roughness(kLevel), 1.0, glm::dvec3(0.0)};
  const LayeredSurface layered = {BlinnMicrofacet{mirror.roughness, 0.0}, glm::dvec3(1.0),
                                  glm::dvec3(0.0)};
  const Extent level = {kMap.width >> kLevel, kMap.height >> kLevel};
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; x += 3) {
      const Direction normal = normal_of_texel(level, x, y);
      const ShadingPoint at = {(1.0 + kSurfaceOffset) * normal, frame_around(normal), normal};
      const LayeredEstimate exact =
          light.reflected(layered, at, RandomStream("along-normal", 1).substream(8 * x + y), 6000);
      const glm::dvec3 shown = maps.shaded(mirror, normal, normal).rgb;
      EXPECT_NEAR(shown.r, exact.radiance.r, 5.0 * exact.standard_error.r) << x << ", " << y;
      EXPECT_NEAR(shown.b, exact.radiance.b, 5.0 * exact.standard_error.b) << x << ", " << y;
    }
  }
}

TEST(TwoMaps, AreRightUnderAWhiteSkyAlongTheNormalButForTheFresnelFactor) {
  const GlossyOnDiffuse mirror = {0.5, 1.0, glm::dvec3(0.0)};
  EXPECT_NEAR(shaded_by_white(mirror, 1.0, TwoMapsForm::corrected).rgb.r,
              white_along_normal(mirror), 1e-9);
  // F(n·v) is F0 there, and the half-vectors' F(v·h) at least that.
  const GlossyOnDiffuse plastic = {0.5, 0.04, glm::dvec3(1.0)};
  const double exact = white_along_normal(plastic);
  const double shown = shaded_by_white(plastic, 1.0, TwoMapsForm::corrected).rgb.r;
  EXPECT_LE(shown, exact);
  EXPECT_NEAR(shown, exact, 1e-3);
}

TEST(TwoMapsAsPublished, SubtractTheLightOfTheOtherSide) {
  const GlossyOnDiffuse surface = {0.5, 0.04, glm::dvec3(1.0)};
  // c pi times the integral of n·l over the hemisphere where it is negative.
  EXPECT_NEAR(shaded_by_white(surface, 1.0, TwoMapsForm::text).rgb.r,
              0.04 * white_reflectivity(0.5, TwoMapsForm::text) - kPi * kPi, 1e-12);
  const EnvironmentMap map = make_synthetic_map("step", kMap);
  const TwoMaps text(map, kMap, kReflectivityLevels, TwoMapsForm::text);
  const Direction lit = glm::normalize(Direction(2.0, 1.0, 2.0));
  EXPECT_GT(text.shaded(surface, lit, lit).rgb.r, -0.1) << "no light comes from behind";
  EXPECT_LT(text.shaded(surface, -lit, -lit).rgb.r, -9.0) << "all light comes from behind";
}

TEST(TwoMapsAsPublished, AreTooBrightByPiWhereTheyAreDiffuse) {
  const GlossyOnDiffuse surface = {0.5, 0.0, glm::dvec3(0.5)};
  const double published = shaded_by_white(surface, 1.0, TwoMapsForm::program).rgb.r;
  const double corrected = shaded_by_white(surface, 1.0, TwoMapsForm::corrected).rgb.r;
  EXPECT_NEAR(published / corrected, kPi / mean_transmittance(0.0), 1e-12);
}

TEST(TwoMapsSphere, IsNearTheOneByBruteForceWhereThePublishedOneIsFar) {
  ShadedPictureOptions options;
  options.picture = {32, 24};
  const PublishedPicture picture = two_maps_picture(options);
  // Of the mean radiance. What is left of the corrected form is the view away from the normal and
  // the Fresnel factor taken out of both integrals.
  RecordProperty("published_rmse", std::to_string(picture.published_rmse));
  RecordProperty("corrected_rmse", std::to_string(picture.corrected_rmse));
  EXPECT_GT(picture.published_rmse, 1.5) << "c E for c E/pi alone is 2.14";
  EXPECT_LT(picture.corrected_rmse, 0.3) << "the Fresnel factor at the silhouette";
  EXPECT_LT(picture.noise, 0.03);
}

}  // namespace
}  // namespace lightproof
