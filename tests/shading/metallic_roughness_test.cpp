#include "lightproof/shading/metallic_roughness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/look_up.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/render/receiver.h"
#include "lightproof/shading/layered_light.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kMap = {128, 64};
constexpr int kLevels = 5;

MetallicRoughness white(double roughness) {
  MetallicRoughness surface;
  surface.roughness = roughness;
  return surface;
}

double under_white_sky(const MetallicRoughness& surface, double cosine, Masking masking,
                       DiffuseShare share = DiffuseShare::published) {
  const ScaleBias brdf = integrate_brdf(cosine, surface.roughness, masking);
  return shaded(surface, cosine, {glm::dvec3(1.0), brdf, glm::dvec3(1.0)}, share).rgb.g;
}

TEST(MetallicRoughness, OfAWhiteSurfaceUnderAWhiteSkyHasThePrintedValues) {
  for (const double cosine : {1.0, 0.5, 0.1}) {
    EXPECT_NEAR(under_white_sky(white(0.0), cosine, Masking::karis), 1.0, 1e-5) << cosine;
  }
  EXPECT_NEAR(under_white_sky(white(1.0), 0.5, Masking::karis), 0.949, 5e-4);
}

TEST(MetallicRoughness, KeepsAllLightWhereTheBaseGetsWhatTheCoatLeaves) {
  for (const double roughness : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(
        under_white_sky(white(roughness), 0.5, Masking::height_correlated, DiffuseShare::remaining),
        1.0, 1e-12);
  }
}

TEST(MetallicRoughness, TakesTheReflectanceOfAMetalFromItsColour) {
  MetallicRoughness surface = white(0.5);
  surface.base_colour = {1.0, 0.7, 0.3};
  EXPECT_EQ(normal_reflectance(surface), glm::dvec3(0.04)) << "0.16 times a half squared";
  surface.metallic = 1.0;
  EXPECT_EQ(normal_reflectance(surface), surface.base_colour);
  const PrecomputedLight diffuse_alone = {glm::dvec3(0.0), {0.5, 0.1}, glm::dvec3(1.0)};
  EXPECT_EQ(shaded(surface, 0.5, diffuse_alone).rgb, glm::dvec3(0.0)) << "no metal is diffuse";
  const PrecomputedLight specular_alone = {glm::dvec3(2.0), {0.5, 0.1}, glm::dvec3(0.0)};
  EXPECT_DOUBLE_EQ(shaded(surface, 0.5, specular_alone).rgb.g, 2.0 * (0.7 * 0.5 + 0.1));
}

TEST(MetallicRoughness, AddsEmissionAndEncodesAll) {
  MetallicRoughness surface = white(0.5);
  surface.emission = display_decoded(glm::dvec3(0.5));
  const Radiance dark = shaded(surface, 0.5, {glm::dvec3(0.0), {0.5, 0.1}, glm::dvec3(0.0)});
  EXPECT_NEAR(display_encoded(dark).r, 0.5, 1e-15);
  EXPECT_NEAR(dark.rgb.r, std::pow(0.5, 2.2), 1e-15);
}

TEST(MetallicRoughnessMaps, HoldAWhiteSkyAsItIs) {
  const MetallicRoughnessMaps maps(make_synthetic_map("constant", kMap), kMap, kLevels);
  const Direction normal = glm::normalize(Direction(1.0, 2.0, 3.0));
  for (const double roughness : {0.0, 0.4, 1.0}) {
    const PrecomputedLight light = maps.look_up(roughness, normal, normal, LevelForm::corrected);
    EXPECT_NEAR(light.prefiltered.r, 1.0, 1e-5);
    EXPECT_NEAR(light.diffuse.r, 1.0, 1e-6) << "E/pi, not E";
  }
}

TEST(MetallicRoughnessMaps, PassTheLastLevelAsPublished) {
  const MetallicRoughnessMaps maps(make_synthetic_map("checker", kMap), kMap, kLevels);
  const Direction normal = glm::normalize(Direction(1.0, 2.0, 0.5));
  const Direction view = glm::normalize(Direction(1.0, 1.0, 0.2));
  const auto prefiltered = [&](double roughness, LevelForm form) {
    return maps.look_up(roughness, normal, view, form).prefiltered.r;
  };
  // R mipCount is the level of R mipCount / (mipCount - 1), and from 0.8 of five levels on the
  // last.
  EXPECT_NEAR(prefiltered(0.4, LevelForm::published), prefiltered(0.5, LevelForm::corrected), 1e-6);
  EXPECT_EQ(prefiltered(0.8, LevelForm::published), prefiltered(1.0, LevelForm::corrected));
  EXPECT_EQ(prefiltered(1.0, LevelForm::published), prefiltered(1.0, LevelForm::corrected));
  EXPECT_NE(prefiltered(0.4, LevelForm::published), prefiltered(0.4, LevelForm::corrected));
}

TEST(MetallicRoughnessMaps, ShowASmoothMetalTheMirroredMap) {
  const EnvironmentMap map = make_synthetic_map("gradient", kMap);
  const MetallicRoughnessMaps maps(map, kMap, kLevels);
  MetallicRoughness mirror = white(0.0);
  mirror.metallic = 1.0;
  const Direction normal = glm::normalize(Direction(0.3, -0.4, 0.6));
  const Direction view = glm::normalize(Direction(0.9, -0.3, 0.5));
  const glm::dvec3 seen =
      look_up_bilinear(map.radiance, square_from_direction(reflect_about(view, normal)));
  for (const LevelForm form : {LevelForm::published, LevelForm::corrected}) {
    const glm::dvec3 shown = shaded(mirror, maps, normal, view, form).rgb;
    // A + B of a mirror is 1; half a texel of the BRDF map from roughness 0 it is a little less.
    EXPECT_NEAR(shown.r, seen.r, 1e-4 * seen.r);
    EXPECT_NEAR(shown.b, seen.b, 1e-4 * seen.b);
  }
}

/// What the lecture's background shows in a direction.
Rgb background(const Grid<Rgb>& map, Direction direction) {
  const SquarePoint at = published::background_position(background_coordinate(direction));
  return look_up_nearest(map, {at.s >= 1.0 ? 0.0 : at.s, at.t});
}

TEST(Background, IsLookedUpWhereTheReflectionsAre) {
  for (const Direction d : {Direction(1.0, 2.0, 3.0), Direction(-1.0, 0.5, -0.2),
                            Direction(0.3, -2.0, 0.1), Direction(-2.0, -0.1, 1.0)}) {
    const Direction direction = glm::normalize(d);
    const SquarePoint reflection = published::position_on_map(direction);
    const SquarePoint seen = published::background_position(background_coordinate(direction));
    EXPECT_NEAR(seen.s, reflection.s, 1e-15);
    EXPECT_NEAR(seen.t, reflection.t, 1e-15);
    // This library's convention, but for half a turn.
    const SquarePoint own = square_from_direction({-direction.x, -direction.y, direction.z});
    EXPECT_NEAR(seen.s, own.s, 1e-12);
    EXPECT_NEAR(seen.t, own.t, 1e-12);
  }
}

TEST(Background, ShowsThePictureUnmirroredFromInside) {
  Grid<Rgb> map(Extent{8, 4});
  map(1, 2) = Rgb(1.0F, 0.0F, 0.0F);  // left of (2, 2) in the picture
  map(2, 2) = Rgb(0.0F, 1.0F, 0.0F);
  map(2, 3) = Rgb(0.0F, 0.0F, 1.0F);  // above (2, 2)
  const auto centre = [](int x, int y) {
    // The inverse of position_on_map.
    const double phi = 2.0 * kPi * (1.0 - (x + 0.5) / 8.0);
    const double theta = kPi * (1.0 - (y + 0.5) / 4.0);
    return Direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     std::cos(theta));
  };
  EXPECT_EQ(background(map, centre(1, 2)), Rgb(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(background(map, centre(2, 2)), Rgb(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(background(map, centre(2, 3)), Rgb(0.0F, 0.0F, 1.0F));
  // Who looks at (2, 2) has (1, 2) on the left and (2, 3) above.
  const Direction forward = centre(2, 2);
  const Direction right = glm::normalize(glm::cross(forward, Direction(0.0, 0.0, 1.0)));
  EXPECT_LT(glm::dot(centre(1, 2), right), 0.0);
  EXPECT_GT(centre(2, 3).z, forward.z);
  // Without the 1 - the picture is mirrored.
  const SquarePoint plain = background_coordinate(centre(1, 2));
  EXPECT_NE(look_up_nearest(map, plain), Rgb(1.0F, 0.0F, 0.0F));
}

/// The pixels of a small picture of a sphere.
std::vector<Pixel> sphere_pixels(const Scene& scene) {
  return visible_pixels(receiver_by_name("sphere"), scene, {24, 18});
}

TEST(MetallicRoughnessSphere, IsTheOneByBruteForceInEveryPixelUnderAWhiteSky) {
  const EnvironmentMap map = make_synthetic_map("constant", kMap);
  const Scene scene({true, false});
  const LayeredLight light(map, scene);
  MetallicRoughness surface = white(0.6);
  surface.base_colour = {0.9, 0.5, 0.2};
  surface.metallic = 0.3;
  const LayeredSurface layered = {Ggx{surface.roughness, 0.0}, normal_reflectance(surface),
                                  (1.0 - surface.metallic) * surface.base_colour};
  const std::vector<Pixel> pixels = sphere_pixels(scene);
  ASSERT_GT(pixels.size(), 80U);
  std::vector<LayeredEstimate> estimates(pixels.size());
  parallel_for(pixels.size(), [&](std::size_t i) {
    estimates[i] = light.reflected(layered, pixels[i].point, RandomStream("white-sphere", i), 6000);
  });
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double cosine = glm::dot(pixels[i].point.frame.normal, pixels[i].point.view);
    const ScaleBias brdf = integrate_brdf(cosine, surface.roughness, Masking::height_correlated);
    const glm::dvec3 formula =
        shaded(surface, cosine, {glm::dvec3(1.0), brdf, glm::dvec3(1.0)}).rgb;
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(formula[channel], estimates[i].radiance[channel],
                  5.0 * estimates[i].standard_error[channel])
          << pixels[i].x << ", " << pixels[i].y;
    }
  }
}

TEST(MetallicRoughnessSphere, IsTheOneByBruteForceWhereItIsDiffuse) {
  // Without a coat but for B, at a roughness that leaves little of it, every map is shaded right.
  const EnvironmentMap map = make_synthetic_map("checker", kMap);
  const Scene scene({true, false});
  const MetallicRoughnessMaps maps(map, kMap, kLevels);
  const LayeredLight light(map, scene);
  MetallicRoughness surface = white(1.0);
  surface.reflectance = 0.0;
  const LayeredSurface layered = {Ggx{1.0, 0.0}, glm::dvec3(0.0), surface.base_colour};
  for (const Pixel& pixel : sphere_pixels(scene)) {
    const double cosine = glm::dot(pixel.point.frame.normal, pixel.point.view);
    if (cosine < 0.5) continue;
    const LayeredEstimate exact = light.reflected(
        layered, pixel.point, RandomStream("diffuse-sphere", 1).substream(pixel.x), 3000);
    const glm::dvec3 shown =
        shaded(surface, maps, pixel.point.frame.normal, pixel.point.view, LevelForm::corrected).rgb;
    // B < 0.0031 at R = 1 and n·v >= 1/2, whatever the map shows up to radiance 1; 1/16 of the
    // normal's width in the 64 x 32 map changes E/pi by less than 0.002.
    EXPECT_NEAR(shown.r, exact.radiance.r, 5.0 * exact.standard_error.r + 0.0051);
  }
}

}  // namespace
}  // namespace lightproof
