#include "lightproof/study/method_regimes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/image/map_figures.h"

namespace lightproof {
namespace {

// Of L = exp(k (z - 1)): ∫L = 2 pi (1 - e^-2k) / k, and of L^2 the same with 2k. Texels of h =
// pi/256 change ∫L by about k h^2/8, which is 3e-4 at k = 20.
TEST(OneLight, FillsAsMuchOfTheSphereAsItsClosedFormSays) {
  for (const double k : {0.5, 3.0, 20.0}) {
    const double fraction =
        std::pow(1.0 - std::exp(-2.0 * k), 2) / (k * (1.0 - std::exp(-4.0 * k)));
    EXPECT_NEAR(figures_of(one_light(k, {512, 256})).effective_fraction / fraction, 1.0, 1e-3) << k;
  }
}

TEST(OneLight, IsBrightestWhereTheCameraSeesItsReflection) {
  const EnvironmentMap map = one_light(50.0, {64, 32});
  float brightest = 0.0F;
  for (const Rgb& texel : map.radiance.values()) brightest = std::max(brightest, texel.r);
  EXPECT_GT(brightest, 0.8F);
  EXPECT_LE(brightest, 1.0F);
}

}  // namespace
}  // namespace lightproof
