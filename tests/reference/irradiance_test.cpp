// Irradiance of maps with closed forms: the reference's mean of L k for the cosine kernel, and its
// sum over texels.
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"
#include "reference/estimator_moments.h"
#include "reference/irradiance.h"
#include "tests/reference/maps.h"

namespace lightproof::reference {
namespace {

constexpr Extent kExtent = {512, 256};
/// Side of a texel in radians.
constexpr double kStep = kPi / 256.0;
/// Axis of the lobe and the step.
constexpr Direction kAxis = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};

double irradiance_at_nodes(const Grid<double>& luminance, Direction normal) {
  const Grid<double> grids[] = {luminance};
  const LightMoments m = light_moments(cosine_kernel(normal), grids).front();
  EXPECT_NEAR(m[SampledDensity::texture_space].mean(), m[SampledDensity::uniform].mean(),
              1e-12 * m[SampledDensity::uniform].mean());
  EXPECT_NEAR(m[SampledDensity::solid_angle].mean(), m[SampledDensity::uniform].mean(),
              1e-12 * m[SampledDensity::uniform].mean());
  return m[SampledDensity::uniform].mean();
}

/// The unit vector at this angle from the axis, in one of two planes through it.
Direction at_angle(double gamma, bool other_plane) {
  const Frame frame = frame_around(kAxis);
  const Direction aside = other_plane ? frame.bitangent : frame.tangent;
  return std::cos(gamma) * kAxis + std::sin(gamma) * aside;
}

constexpr double kAngles[] = {0.0, 0.4, 1.0, 0.5 * kPi, 2.0, 2.7};

TEST(Irradiance, OfTheStepIsThatOfASphericalWedge) {
  const Grid<double> luminance = luminance_of(make_synthetic_map("step", kExtent));
  // Texels within half a diagonal r of the edge may be wrong. The band of half-width r around a
  // great circle adds at most r times the integral of (n.w)+ along the circle, which is 2, on the
  // side of falsely lit texels, and no more on the other: |error| <= 2 r. Both sides are alike but
  // for chance, so the actual error is far below.
  const double radius = 0.5 * std::hypot(kStep, kStep);
  for (const double gamma : kAngles) {
    for (const bool other : {false, true}) {
      const double exact = kPi * (1.0 + std::cos(gamma)) / 2.0;
      EXPECT_NEAR(irradiance_at_nodes(luminance, at_angle(gamma, other)), exact, 2.0 * radius)
          << gamma;
    }
  }
}

TEST(Irradiance, OfTheCosineLobeIsItsClosedForm) {
  const Grid<double> luminance = luminance_of(make_synthetic_map("cosine-lobe", kExtent));
  // The value at the centre of a texel stands for all of it. By Taylor in theta and phi the error
  // is h^2/12 times the integral of L_tt/2 k sin + L_t (k sin)_t + (L_pp/2 k + L_p k_p) sin over
  // the pi^2 of (theta, phi) where k = (n.w)+ is positive; every factor is a projection of a unit
  // vector, so that the four terms are at most 1/2, 1, 1/2 and 1. The kink is off by d/8 inside a
  // band of the texel's diagonal d, on a circle where k integrates to 2: h^2/2. And 32-bit floats.
  const double bound = kStep * kStep * (kPi * kPi / 4.0 + 0.5) + 1e-6;
  for (const double gamma : kAngles) {
    for (const bool other : {false, true}) {
      const double exact = 2.0 / 3.0 * ((kPi - gamma) * std::cos(gamma) + std::sin(gamma));
      EXPECT_NEAR(irradiance_at_nodes(luminance, at_angle(gamma, other)), exact, bound) << gamma;
    }
  }
}

TEST(Irradiance, OfTheGradientIsLinearInTheNormal) {
  // L = c (1 + z/2): E = pi c (1 + n.z/3); of z the centre is off the mean by a factor 1 - h^2/24.
  const Grid<double> luminance = luminance_of(make_synthetic_map("gradient", kExtent));
  const double c = 0.2126 + 0.7152 * 0.75 + 0.0722 * 0.5;
  for (const Direction along :
       {Direction(0, 0, 1), Direction(0, 0, -1), Direction(1, 0, 0), Direction(1, -2, 2) / 3.0}) {
    const double exact = kPi * c * (1.0 + along.z / 3.0);
    EXPECT_NEAR(irradiance_at_nodes(luminance, along), exact, kPi * (kStep * kStep / 24.0) + 1e-6);
  }
}

TEST(Irradiance, OfOneVisibleTexelIsItsExactVector) {
  // E = n.V, V = (int sin^2 (sin phi1 - sin phi0), int sin^2 (cos phi0 - cos phi1),
  // dphi [sin^2/2]); the texel (170, 192) of 512 x 256, well above the horizon of the normals.
  const Grid<double> luminance = luminance_of(make_synthetic_map("one-texel", kExtent));
  ASSERT_NEAR(luminance(170, 192), 1.0, 1e-15);
  const double phi0 = kPi - 2.0 * kPi * 171.0 / 512.0;
  const double phi1 = kPi - 2.0 * kPi * 170.0 / 512.0;
  const double theta0 = kPi * (1.0 - 193.0 / 256.0);
  const double theta1 = kPi * (1.0 - 192.0 / 256.0);
  const auto primitive = [](double theta) { return 0.5 * theta - 0.25 * std::sin(2.0 * theta); };
  const double sine_square = primitive(theta1) - primitive(theta0);
  const Direction v = {
      sine_square * (std::sin(phi1) - std::sin(phi0)),
      sine_square * (std::cos(phi0) - std::cos(phi1)),
      (phi1 - phi0) * 0.5 * (std::pow(std::sin(theta1), 2) - std::pow(std::sin(theta0), 2))};
  for (const Direction along : {Direction(0, 0, 1), Direction(1, 1, 1), Direction(1, 2, 0)}) {
    const Direction normal = glm::normalize(along);
    ASSERT_GT(glm::dot(normal, v), 0.0);
    // Gauss-Legendre: h^4/4320 = 5e-12 of it, and the luminance weights' own rounding.
    EXPECT_NEAR(irradiance_at_nodes(luminance, normal) / glm::dot(normal, v), 1.0, 1e-10);
  }
  EXPECT_EQ(irradiance_at_nodes(luminance, -glm::normalize(v)), 0.0);
}

TEST(Irradiance, TexelByTexelIsThatOfTheNodes) {
  const Extent extent = {33, 17};
  std::vector<float> values;
  for (std::size_t i = 0; i < extent.count(); ++i) values.push_back(static_cast<float>(i % 7));
  const EnvironmentMap map = grey_map(extent, values);
  // Nodes take cells of the horizon of h = pi/2048: of their number 2 pi/h, area h^2 and values up
  // to h, an eighth may be wrong, with radiance up to 6.
  const double tolerance = 6.0 * 2.0 * kPi / 8.0 * std::pow(kPi / 2048.0, 2);
  for (const Direction along : {Direction(0, 0, 1), Direction(1, 0, 0), Direction(1, -2, -3)}) {
    const Direction normal = glm::normalize(along);
    EXPECT_NEAR(reference::irradiance(map, normal).g,
                irradiance_at_nodes(luminance_of(map), normal), tolerance);
  }
}

TEST(Irradiance, TexelByTexelOfConstantLightIsPi) {
  for (const Extent extent : kExtents) {
    const EnvironmentMap map = grey_map(extent, std::vector<float>(extent.count(), 1.0F));
    for (const Direction along :
         {Direction(0, 0, -1), Direction(1, 0, 1e-3), Direction(1, -2, 3)}) {
      EXPECT_NEAR(reference::irradiance(map, glm::normalize(along)).r, kPi, 1e-11);
    }
  }
}

}  // namespace
}  // namespace lightproof::reference
