#include "lightproof/prefilter/riemann_irradiance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "tests/prefilter/maps.h"

namespace lightproof {
namespace {

glm::dvec3 white(Direction /*direction*/) { return glm::dvec3(1.0); }
/// L = 1 + z/2, of which a white surface reflects 1 + n.z/3.
glm::dvec3 gradient(Direction d) { return glm::dvec3(1.0 + 0.5 * d.z); }

constexpr auto kMidpoint = RiemannNodes::midpoint;
constexpr auto kEndpoint = RiemannNodes::endpoint;

TEST(RiemannSum, OfConstantLightIsOffByAKnownFactor) {
  for (const Direction normal : trying_normals()) {
    const auto published = [&](RiemannRule rule) {
      return riemann_reflection_published(white, normal, rule).rgb.g;
    };
    EXPECT_NEAR(published({16, 10, kMidpoint}), 1.004124, 5e-7);
    EXPECT_NEAR(published({16, 10, kEndpoint}), 0.991762, 5e-7);
    for (const int polar : {1, 2, 3, 7, 64}) {
      const double x = 0.5 * kPi / polar;
      EXPECT_NEAR(published({3, polar, kMidpoint}), x / std::sin(x), 1e-14);
      if (polar == 1) continue;
      EXPECT_NEAR(published({1, polar, kEndpoint}), x / std::tan(x), 1e-14);
    }
  }
}

TEST(RiemannSum, CorrectedIsExactForConstantLight) {
  for (const RiemannNodes nodes : {kMidpoint, kEndpoint}) {
    for (const int polar : {2, 5, 40}) {
      EXPECT_NEAR(riemann_reflection(white, {0.6, 0, 0.8}, {4, polar, nodes}).rgb.b, 1.0, 1e-14);
    }
  }
}

TEST(RiemannSum, ConvergesQuadraticallyForSmoothLight) {
  // With two azimuths and more, what is odd in them cancels: left is L = 1 + n.z cos(theta)/2, and
  // of a function of theta both rules are off by the square of the step.
  const Direction normal = glm::normalize(Direction(1, 2, 2));
  const double exact = 1.0 + normal.z / 3.0;
  for (const RiemannNodes nodes : {kMidpoint, kEndpoint}) {
    const auto error = [&](int polar) {
      return riemann_reflection(gradient, normal, {8, polar, nodes}).rgb.r - exact;
    };
    // The next term is the fourth power: a relative (pi/2J)^2 of the first.
    EXPECT_NEAR(error(20) / error(40), 4.0, 4.0 * std::pow(0.5 * kPi / 20, 2));
    EXPECT_LT(std::abs(error(40)), std::pow(0.5 * kPi / 40, 2));
  }
}

TEST(RiemannSum, TakesTheTexelsOfAMap) {
  // One azimuth and one polar angle: the node at 45 degrees, opposite the tangent.
  const EnvironmentMap map = random_map({16, 8});
  const Direction normal = glm::normalize(Direction(3, 1, 2));
  const Direction node = (normal - frame_around(normal).tangent) / std::sqrt(2.0);
  const SquarePoint at = square_from_direction(node);
  const glm::dvec3 texel(map.radiance(static_cast<int>(at.s * 16), static_cast<int>(at.t * 8)));
  const glm::dvec3 sum =
      riemann_reflection_published(NearestRadiance(map), normal, {1, 1, kMidpoint}).rgb;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 0.5 * kPi * texel[c], 1e-15);
}

TEST(RiemannSum, RefusesTooFewSteps) {
  const auto refusal = [](RiemannRule rule) -> std::string {
    try {
      riemann_reflection(white, {0, 0, 1}, rule);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refusal({0, 4, kMidpoint}), testing::HasSubstr("0 azimuths"));
  EXPECT_THAT(refusal({4, 0, kMidpoint}), testing::HasSubstr("0 polar"));
  EXPECT_THAT(refusal({4, 1, kEndpoint}), testing::HasSubstr("at least 1 and 2"));
  EXPECT_EQ(refusal({4, 1, kMidpoint}), "");
}

}  // namespace
}  // namespace lightproof
