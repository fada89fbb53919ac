#include "lightproof/materials/blinn_half_vector.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>

#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/moment_tests.h"

namespace lightproof {
namespace {

constexpr double kRoughnesses[] = {0.01, 0.1, 0.3, 0.5, 0.75, 1.0};

TEST(BlinnShininess, IsThatOfTheRoughness) {
  EXPECT_EQ(blinn_shininess(1.0), 0.0);
  EXPECT_EQ(blinn_shininess(0.5), 30.0);
  EXPECT_NEAR(blinn_shininess(0.01) / 2e8, 1.0, 1e-7);
}

// Seven levels stand at (i + 1/2)/7, so that a roughness R is found at level 7R - 1/2.
TEST(BlinnShininess, HasLevelsInTheMiddlesOfSevenths) {
  EXPECT_NEAR(blinn_roughness_of_level(0, 7), 0.5 / 7.0, 1e-16);
  EXPECT_NEAR(blinn_roughness_of_level(6, 7), 6.5 / 7.0, 1e-16);
  for (int level = 0; level < 7; ++level) {
    EXPECT_NEAR(blinn_level_of_roughness(blinn_roughness_of_level(level, 7), 7), level, 1e-14);
    EXPECT_GT(blinn_shininess(blinn_roughness_of_level(level, 7)), 0.0);
  }
}

// As published, roughness goes from 0.5 to 6.5 undivided: the first level has the shininess of a
// roughness that is seven times too large, all others have a negative one.
TEST(PublishedBlinn, HasNegativeShininessFromItsSecondLevelOn) {
  EXPECT_EQ(published::blinn_shininess(0.5), 30.0);
  for (const double roughness : {1.5, 2.5, 3.5, 4.5, 5.5, 6.5}) {
    const double shininess = published::blinn_shininess(roughness);
    EXPECT_LT(shininess, -1.5);
    EXPECT_GT(shininess, -2.0);
    // S + 1 < 0: "cosines" above 1, and no sine.
    const Direction h = published::blinn_normal_from_square(shininess, {0.5, 0.3});
    EXPECT_GT(h.z, 1.0);
    EXPECT_TRUE(std::isnan(h.x));
    EXPECT_LT(published::blinn_normal_pdf(shininess, 0.5), 0.0);
  }
  EXPECT_TRUE(std::isinf(published::blinn_shininess(0.0)));
}

/// ∫ f over the upper hemisphere of a function of the angle to the normal.
template <class Integrand>
double over_hemisphere(const Integrand& f) {
  boost::math::quadrature::tanh_sinh<double> rule;
  return rule.integrate(
      [&](double theta) {
        return 2.0 * kPi * std::sin(theta) * f(Direction(std::sin(theta), 0.0, std::cos(theta)));
      },
      0.0, 0.5 * kPi);
}

TEST(BlinnNormalDistribution, HasTheProjectedAreaOfTheSurface) {
  for (const double roughness : kRoughnesses) {
    const double shininess = blinn_shininess(roughness);
    const auto area = [&](Direction h) { return blinn_normal_distribution(shininess, h) * h.z; };
    EXPECT_NEAR(over_hemisphere(area), 1.0, 1e-8) << roughness;
  }
}

TEST(BlinnPdfs, IntegrateToOneWhereThePublishedOneIntegratesToTwoPi) {
  for (const double roughness : kRoughnesses) {
    const double s = blinn_shininess(roughness);
    EXPECT_NEAR(over_hemisphere([&](Direction h) { return blinn_normal_pdf(s, h).value; }), 1.0,
                1e-8);
    EXPECT_NEAR(over_hemisphere([&](Direction h) { return blinn_lobe_pdf(s, h).value; }), 1.0,
                1e-8);
    // (S+1) cosine^S is a density of the cosine.
    EXPECT_NEAR(over_hemisphere([&](Direction h) { return published::blinn_normal_pdf(s, h.z); }),
                2.0 * kPi, 1e-7);
  }
}

// P(cosine >= c) is 1 - c^(n+1) for a density proportional to cosine^n: u.t at that cosine.
TEST(BlinnNormals, StandAtTheCosinesOfTheirDensity) {
  for (const double roughness : kRoughnesses) {
    const double s = blinn_shininess(roughness);
    for (const double t : {0.0, 1e-6, 0.3, 0.9, 1.0 - 0x1p-53}) {
      const Direction normal = blinn_normal_from_square(s, {0.2, t});
      const Direction lobe = blinn_lobe_from_square(s, {0.2, t});
      EXPECT_NEAR(glm::length(normal), 1.0, 4e-16);
      EXPECT_NEAR(cosine_to_power(normal, s + 2.0), 1.0 - t, 1e-13);
      EXPECT_NEAR(cosine_to_power(lobe, s + 1.0), 1.0 - t, 1e-13);
      EXPECT_NEAR(std::atan2(lobe.y, lobe.x), t > 0.0 ? 0.4 * kPi : 0.0, 1e-15);
    }
  }
}

TEST(PublishedBlinn, DrawsTheLobeWithTheOtherEndOfTheNumber) {
  for (const double t : {0.1, 0.5, 0.9}) {
    const Direction published = published::blinn_normal_from_square(30.0, {1.0 - t, 0.2});
    EXPECT_NEAR(glm::distance(published, blinn_lobe_from_square(30.0, {0.2, t})), 0.0, 1e-14);
  }
}

// 2 pi for the density, 1/4 of the model: 2/pi.
TEST(PublishedBlinn, WeighsByTwoOverPiTimesTheCorrectedWeight) {
  for (const double roughness : kRoughnesses) {
    const double s = blinn_shininess(roughness);
    for (const double cosine : {1.0, 1.0 - 1e-9}) {
      const double corrected = blinn_lobe_weight(s, cosine);
      EXPECT_NEAR(published::blinn_weight(s, cosine), 2.0 / kPi * corrected, 1e-12);
    }
  }
  EXPECT_NEAR(published::blinn_weight(30.0, 0.9), 2.0 / kPi * 32.0 / 31.0 * 0.9, 1e-15);
}

// D / (4 p): what the corrected weight is, from its parts.
TEST(BlinnLobeWeight, IsDistributionOverDensity) {
  for (const double roughness : kRoughnesses) {
    const double s = blinn_shininess(roughness);
    for (const double t : {0.01, 0.5, 0.99}) {
      const Direction h = blinn_lobe_from_square(s, {0.1, t});
      const double ratio = blinn_normal_distribution(s, h) * h.z / blinn_lobe_pdf(s, h).value;
      EXPECT_NEAR(blinn_lobe_weight(s, h.z), ratio, 1e-12);
      EXPECT_NEAR(blinn_normal_distribution(s, h) * h.z / blinn_normal_pdf(s, h).value, 1.0, 1e-14);
    }
  }
}

// E[c] = (S+1)/(S+2), E[c^2] = (S+1)/(S+3), and so on: mean 1, variance 1/((S+1)(S+3)).
TEST(BlinnLobeWeight, HasMeanOneAndItsVariance) {
  constexpr std::uint64_t kSamples = 1U << 20U;
  for (const double roughness : {0.3, 0.5, 0.75, 1.0}) {
    const double s = blinn_shininess(roughness);
    const RandomStream stream("BlinnLobeWeight", static_cast<std::uint64_t>(1000 * roughness));
    Moments weights;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      weights.add(blinn_lobe_weight(s, blinn_lobe_from_square(s, stream.point(i)).z));
    }
    const double variance = 1.0 / ((s + 1.0) * (s + 3.0));
    const double scale = (s + 2.0) / (s + 1.0);
    const auto raw = [&](double k) { return std::pow(scale, k) * (s + 1.0) / (s + 1.0 + k); };
    const double fourth = raw(4) - 4.0 * raw(3) + 6.0 * raw(2) - 3.0;
    // Eight tests of this file share 1e-6.
    const double level = std::log10(1e-6 / 8.0);
    EXPECT_GT(mean_test(weights, {1.0, variance}).log10_p, level) << roughness;
    EXPECT_GT(variance_test(weights, {1.0, variance}, fourth).log10_p, level) << roughness;
  }
}

TEST(CosineToPower, AgreesWithPowWherePowHasDigits) {
  for (const double theta : {0.1, 0.7, 0.9, 1.5}) {
    const Direction h = {std::sin(theta) * 0.6, std::sin(theta) * 0.8, std::cos(theta)};
    for (const double n : {0.0, 1.0, 30.0}) {
      const double expected = std::pow(std::cos(theta), n);
      EXPECT_NEAR(cosine_to_power(h, n), expected, 1e-13 * expected);
    }
  }
}

}  // namespace
}  // namespace lightproof
