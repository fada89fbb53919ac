// Shares of the sphere that lobes fill, against closed forms.
#include "lightproof/recommend/lobe_share.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

// (∫cos)^2 / ∫cos^2 = pi^2 / (2 pi / 3), of 4 pi three eighths.
TEST(LobeShare, OfACosineIsThreeEighths) { EXPECT_NEAR(lobe_share(Lambert{0.5}), 0.375, 1e-5); }

// Seen along the normal, Phong's lobe alone is cos^(n+1): ∫ is 2 pi / (n+2), of its square 2 pi /
// (2n+3).
TEST(LobeShare, OfPhongsLobeHasAClosedForm) {
  for (const double n : {1.0, 20.0, 1000.0}) {
    const double share = 0.5 * (2.0 * n + 3.0) / ((n + 2.0) * (n + 2.0));
    EXPECT_NEAR(lobe_share(ModifiedPhong{0.0, 1.0, n}) / share, 1.0, 1e-3) << n;
  }
}

// With a diffuse part of albedo d: ∫ρ = d + s (n+2)/(n+2), and ∫ρ^2 is that of both and of twice
// their product, d/pi s (n+2)/2pi ∫cos^(n+2) = d s (n+2) / (pi (n+3)).
TEST(LobeShare, OfPhongWithADiffusePartIsThatOfBoth) {
  const double d = 0.4;
  const double s = 0.5;
  const double n = 50.0;
  const double of_diffuse = d * d * 2.0 / (3.0 * kPi);
  const double of_lobe = s * s * (n + 2.0) * (n + 2.0) / (2.0 * kPi * (2.0 * n + 3.0));
  const double of_product = 2.0 * d * s * (n + 2.0) / (kPi * (n + 3.0));
  const double share = (d + s) * (d + s) / (of_diffuse + of_lobe + of_product) / kSphere;
  EXPECT_NEAR(lobe_share(ModifiedPhong{d, s, n}) / share, 1.0, 1e-3);
}

// The narrowest is as wide as its roughness squared: its density is D(h) of alpha = r^2, for which
// (∫D cos)^2 / ∫(D cos)^2 over half-vectors is 3 pi alpha^2 for small alpha, over directions four
// times that, and Fresnel's and the masking's terms are even there.
TEST(LobeShare, OfNarrowGgxFallsAsTheFourthPowerOfRoughness) {
  const double narrow = lobe_share(material_of("ggx:0.02"));
  const double wider = lobe_share(material_of("ggx:0.04"));
  EXPECT_NEAR(wider / narrow, 16.0, 0.1);
  EXPECT_NEAR(narrow / (3.0 * std::pow(0.02, 4)), 1.0, 0.01);
}

TEST(LobeShare, OfBlinnFallsWithItsExponent) {
  const double wide = lobe_share(material_by_name("blinn").material);
  EXPECT_LT(wide, 0.2);
  EXPECT_GT(wide, 0.0);
}

}  // namespace
}  // namespace lightproof
