#include "lightproof/materials/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

TEST(SchlickFresnel, GoesFromNormalReflectanceToOne) {
  for (const double f0 : {0.0, 0.04, 0.5, 1.0}) {
    EXPECT_EQ(schlick_fresnel(f0, 1.0), f0);
    EXPECT_EQ(schlick_fresnel(f0, 0.0), 1.0);
    EXPECT_NEAR(schlick_fresnel(f0, 0.5), f0 + (1.0 - f0) / 32.0, 1e-15);
  }
}

// The cosine-weighted mean of F0 + (1 - F0)(1 - c)^5 over the hemisphere: ∫ 2c (1-c)^5 dc = 1/21.
TEST(SchlickFresnel, LeavesTwentyTwentyFirstsOfWhatEntersOnAverage) {
  constexpr int kSteps = 1000;
  double mean = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    mean += 2.0 * cosine * (1.0 - schlick_fresnel(0.04, cosine)) / kSteps;
  }
  // Midpoints: |f''| <= 20 everywhere, over 24 steps^2.
  EXPECT_NEAR(mean, 0.96 * 20.0 / 21.0, 1e-6);
}

TEST(SchlickFresnelOfRoughness, IsSchlicksOwnForAMirror) {
  for (const double f0 : {0.0, 0.04, 0.9}) {
    for (const double cosine : {0.0, 0.1, 0.5, 1.0}) {
      EXPECT_EQ(schlick_fresnel_of_roughness(f0, 0.0, cosine), schlick_fresnel(f0, cosine));
    }
  }
}

TEST(SchlickFresnelOfRoughness, GoesToOneLessRoughnessAtGrazingAndNeverBelowItsStart) {
  EXPECT_NEAR(schlick_fresnel_of_roughness(0.04, 0.3, 0.0), 0.7, 1e-15);
  EXPECT_EQ(schlick_fresnel_of_roughness(0.04, 0.3, 1.0), 0.04);
  EXPECT_NEAR(schlick_fresnel_of_roughness(0.04, 0.3, 0.5), 0.04 + 0.66 / 32.0, 1e-15);
  for (const double cosine : {0.0, 0.3, 1.0}) {
    EXPECT_EQ(schlick_fresnel_of_roughness(0.5, 0.8, cosine), 0.5);
  }
}

// Rounding leaves cosines a little beyond [0,1].
TEST(SchlickFresnel, StaysBetweenItsEndsForCosinesBesideTheirRange) {
  EXPECT_EQ(schlick_fresnel(0.04, 1.0 + 1e-9), 0.04);
  EXPECT_EQ(schlick_fresnel(0.04, -0.1), 1.0);
}

}  // namespace
}  // namespace lightproof
