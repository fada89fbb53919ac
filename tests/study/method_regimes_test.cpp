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

AccuracyLine line_of(const char* estimator, bool is_biased, double seconds, double error) {
  AccuracyLine line;
  line.estimator = estimator;
  line.family = is_biased ? EstimatorFamily::precomputed : EstimatorFamily::lobes;
  line.is_biased = is_biased;
  line.points = {{1, seconds, error, 0.01 * error}, {4, 4.0 * seconds, 0.5 * error, 0.01 * error}};
  return line;
}

TEST(RegimeOf, NamesTheFastestWithBiasAndWithout) {
  AccuracyChart chart;
  chart.lines = {line_of("brdf", false, 1e-6, 0.1), line_of("sh-9", true, 1e-8, 0.04),
                 line_of("uniform", false, 1e-6, 1.0)};
  const MethodRegime regime = regime_of(chart, 0.3, 0.02);
  EXPECT_EQ(regime.roughness, 0.3);
  EXPECT_EQ(regime.effective_fraction, 0.02);
  EXPECT_EQ(regime.estimator, "sh-9");
  EXPECT_EQ(regime.family, EstimatorFamily::precomputed);
  EXPECT_DOUBLE_EQ(regime.seconds, 1e-8);
  EXPECT_EQ(regime.unbiased_estimator, "brdf");
  EXPECT_NEAR(regime.unbiased_seconds, 4e-6, 1e-18);  // where 10 % has fallen to 5 %
  chart.lines = {line_of("uniform", false, 1e-6, 1.0)};
  EXPECT_EQ(regime_of(chart, 0.3, 0.02).estimator, "");
  EXPECT_EQ(regime_of(chart, 0.3, 0.02).unbiased_estimator, "");
  EXPECT_EQ(regime_of(chart, 0.3, 0.02).family, std::nullopt);
}

}  // namespace
}  // namespace lightproof
