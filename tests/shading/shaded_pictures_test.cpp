#include "lightproof/shading/shaded_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/prefilter/brdf_map.h"

namespace lightproof {
namespace {

ShadedPictureOptions small() {
  ShadedPictureOptions options;
  options.picture = {32, 24};
  options.samples = 768;
  return options;
}

double mean_luminance(const Grid<Rgb>& picture) {
  double sum = 0.0;
  for (const Rgb& rgb : picture.values()) sum += luminance_of(rgb);
  return sum / static_cast<double>(picture.extent().count());
}

TEST(ShadedPictures, AreOfOneSizeAndCorrectWhatIsPublished) {
  for (const PublishedPicture& picture : shaded_pictures(small())) {
    const Extent extent = picture.exact.extent();
    EXPECT_EQ(picture.published.extent(), extent) << picture.system;
    EXPECT_EQ(picture.corrected.extent(), extent);
    EXPECT_EQ(picture.published_error.extent(), extent);
    EXPECT_EQ(picture.corrected_error.extent(), extent);
    EXPECT_LT(picture.corrected_rmse, picture.published_rmse) << picture.system;
    EXPECT_LT(picture.noise, picture.published_rmse) << picture.system;
    EXPECT_FALSE(picture.what.empty());
    EXPECT_FALSE(picture.exact_form.empty());
  }
}

TEST(ReflectivityPicture, AsPublishedIsTooDarkByTwoOverPi) {
  const PublishedPicture picture = reflectivity_picture(small());
  const double exact = mean_luminance(picture.exact);
  // At R = 0.5 next to no sample is skipped. The mean of 4608 texels of 1024 samples is right to
  // less than 1e-3.
  EXPECT_NEAR(mean_luminance(picture.published) / exact, 2.0 / kPi, 2e-3);
  EXPECT_NEAR(mean_luminance(picture.corrected) / exact, 1.0, 2e-3);
}

TEST(ShadedSphere, ByTheExactFormErrsByTheNoiseOfBruteForceAlone) {
  const EnvironmentMap map = make_synthetic_map("constant", {16, 8});
  const LayeredSurface surface = {Ggx{1.0, 0.0}, glm::dvec3(0.04), glm::dvec3(0.5)};
  const ShadePoint exact = [&](const ShadingPoint& at) {
    const double cosine = glm::dot(at.frame.normal, at.view);
    const double coat = integrate_brdf(cosine, 1.0, Masking::height_correlated).reflected(0.04);
    return glm::dvec3(coat + 0.5 * (1.0 - schlick_fresnel(0.04, cosine)));
  };
  const ShadePoint brighter = [&](const ShadingPoint& at) { return 1.1 * exact(at); };
  const PublishedPicture picture = shaded_sphere(map, surface, brighter, exact, small());
  // Brighter by a tenth: the root mean square of a tenth of the radiance over its mean, a little
  // more than 0.1 because the sphere is not equally bright.
  EXPECT_NEAR(picture.published_rmse, 0.1, 0.01);
  EXPECT_LT(picture.corrected_rmse, 2.0 * picture.noise);
  // Beside the sphere there is no error, and the pictures are alike.
  EXPECT_EQ(picture.published_error(0, 0), 0.0);
  EXPECT_EQ(picture.published(0, 0), picture.exact(0, 0));
}

TEST(ShadedPictures, AreTheSameBitsForAnyNumberOfThreads) {
  const auto bits = [](int threads) {
    const ThreadLimit limit(threads);
    return metallic_roughness_picture(small()).exact;
  };
  const Grid<Rgb> one = bits(1);
  const Grid<Rgb> many = bits(3);
  EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
}

}  // namespace
}  // namespace lightproof
