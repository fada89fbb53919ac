// Irradiance of one normal: texel by texel against quadrature, and of whole maps against closed
// forms. A map below and a map above a function that is not constant in texels enclose it, and so
// does the irradiance.
#include "lightproof/prefilter/irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lightproof/prefilter/irradiance_bracket.h"
#include "reference/irradiance.h"
#include "tests/prefilter/maps.h"

namespace lightproof {
namespace {

TEST(Irradiance, OfEveryTexelIsItsQuadrature) {
  for (const Extent extent : {Extent{1, 1}, {2, 1}, {1, 2}, {3, 2}, {1, 5}, {5, 3}, {8, 4}}) {
    for (const Direction normal : trying_normals()) {
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const double expected = reference::clamped_cosine_of_texel(extent, x, y, normal);
          const double actual = irradiance(one_lit_texel(extent, x, y), normal).rgb.g;
          // Quadrature: 1e-12 of up to pi, from a row of up to five parts.
          EXPECT_NEAR(actual, expected, 4e-12)
              << extent.width << 'x' << extent.height << " (" << x << ", " << y << "), normal "
              << normal.x << ' ' << normal.y << ' ' << normal.z;
        }
      }
    }
  }
}

TEST(Irradiance, OfConstantLightIsPi) {
  for (const Extent extent : kTryingExtents) {
    const EnvironmentMap map{"constant", Grid<Rgb>(extent, Rgb(1.0F, 0.5F, 2.0F)), {}};
    for (const Direction normal : trying_normals()) {
      const glm::dvec3 actual = irradiance(map, normal).rgb;
      // Each weight is a difference of numbers up to 4, rounded to 2^-52.
      const double tolerance = 4e-15 * static_cast<double>(extent.count());
      EXPECT_NEAR(actual.r, kPi, tolerance);
      EXPECT_NEAR(actual.g, 0.5 * kPi, tolerance);
      EXPECT_NEAR(actual.b, 2.0 * kPi, tolerance);
    }
  }
}

TEST(Irradiance, OfATexelInSightIsItsVector) {
  // E = L n·V, V = (∫sin² (sin phi1 - sin phi0), ∫sin² (cos phi0 - cos phi1), dphi [sin²/2]).
  const Extent extent = {64, 32};
  const int x = 20;
  const int y = 25;
  const double phi0 = kPi - 2.0 * kPi * (x + 1) / 64.0;
  const double phi1 = kPi - 2.0 * kPi * x / 64.0;
  const double theta0 = kPi * (1.0 - (y + 1) / 32.0);
  const double theta1 = kPi * (1.0 - y / 32.0);
  const double sine_squared =
      0.5 * (theta1 - theta0) - 0.25 * (std::sin(2.0 * theta1) - std::sin(2.0 * theta0));
  const Direction v = {
      sine_squared * (std::sin(phi1) - std::sin(phi0)),
      sine_squared * (std::cos(phi0) - std::cos(phi1)),
      (phi1 - phi0) * 0.5 * (std::pow(std::sin(theta1), 2) - std::pow(std::sin(theta0), 2))};
  const EnvironmentMap map = one_lit_texel(extent, x, y, 1e5F);
  for (const Direction along : {Direction(0, 0, 1), Direction(1, 1, 1), Direction(0.2, 0.9, 0.1)}) {
    const Direction normal = glm::normalize(along);
    ASSERT_GT(glm::dot(normal, glm::normalize(v)), 0.2);
    EXPECT_NEAR(irradiance(map, normal).rgb.r, 1e5 * glm::dot(normal, v), 1e5 * 4e-15);
  }
}

TEST(Irradiance, OfLightBelowTheHorizonIsZeroExactly) {
  const Extent extent = {64, 32};
  for (const int x : {0, 13, 63}) {
    for (const int y : {0, 9, 31}) {
      const Direction away = -direction_from_square({(x + 0.5) / 64, (y + 0.5) / 32});
      EXPECT_EQ(irradiance(one_lit_texel(extent, x, y, 1e9F), away).rgb, glm::dvec3(0.0));
    }
  }
}

TEST(Irradiance, TurnsWithTheMap) {
  const Extent extent = {12, 7};
  const EnvironmentMap map = random_map(extent);
  for (const int columns : {1, 5, 11}) {
    EnvironmentMap turned = map;
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        turned.radiance((x + columns) % extent.width, y) = map.radiance(x, y);
      }
    }
    // s runs against phi.
    const double angle = -2.0 * kPi * columns / extent.width;
    for (const Direction n : trying_normals()) {
      const Direction normal = {std::cos(angle) * n.x - std::sin(angle) * n.y,
                                std::sin(angle) * n.x + std::cos(angle) * n.y, n.z};
      const double tolerance = 4e-15 * sum_of_texels(map);
      EXPECT_NEAR(irradiance(turned, normal).rgb.r, irradiance(map, n).rgb.r, tolerance);
    }
  }
}

constexpr Direction kAxis = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};
constexpr Extent kFine = {512, 256};
/// No point of a texel is farther from its centre than half a diagonal of a square one.
const double kRadius = 0.5 * std::hypot(kPi / 256.0, kPi / 256.0);

/// Bounds of the irradiance of L = profile(angle to the axis), a profile that does not increase: in
/// every texel the value at its farthest and at its nearest angle, at most.
std::pair<double, double> enclosed(const std::function<double(double)>& profile, Direction normal) {
  EnvironmentMap below{"below", Grid<Rgb>(kFine), {}};
  EnvironmentMap above = below;
  for (int y = 0; y < kFine.height; ++y) {
    for (int x = 0; x < kFine.width; ++x) {
      const Direction d = direction_from_square({(x + 0.5) / 512, (y + 0.5) / 256});
      const double angle = std::acos(std::clamp(glm::dot(d, kAxis), -1.0, 1.0));
      below.radiance(x, y) = Rgb(static_cast<float>(profile(std::min(kPi, angle + kRadius))));
      above.radiance(x, y) = Rgb(static_cast<float>(profile(std::max(0.0, angle - kRadius))));
    }
  }
  return {irradiance(below, normal).rgb.r, irradiance(above, normal).rgb.r};
}

/// The unit vector at this angle from the axis, in one of two planes through it.
Direction at_angle(double gamma, bool other_plane) {
  const Frame frame = frame_around(kAxis);
  return std::cos(gamma) * kAxis +
         std::sin(gamma) * (other_plane ? frame.bitangent : frame.tangent);
}

constexpr double kAngles[] = {0.0, 0.4, 1.0, 0.5 * kPi, 2.0, 2.7};
/// Radiances are rounded to float.
constexpr double kFloat = 6e-8 * kPi;

/// `exact` is the irradiance at an angle to the axis; the two maps may differ by `gap`.
void expect_enclosed(const std::function<double(double)>& profile,
                     const std::function<double(double)>& exact, double gap) {
  for (const double gamma : kAngles) {
    for (const bool other_plane : {false, true}) {
      const auto [low, high] = enclosed(profile, at_angle(gamma, other_plane));
      EXPECT_LE(low, exact(gamma) + kFloat) << gamma;
      EXPECT_GE(high, exact(gamma) - kFloat) << gamma;
      EXPECT_LE(high - low, gap) << gamma;
    }
  }
}

TEST(Irradiance, OfAStepIsItsClosedForm) {
  // The maps differ within two radii of a great circle, along which the clamped cosine integrates
  // to 2 at most.
  expect_enclosed([](double angle) { return angle < 0.5 * kPi ? 1.0 : 0.0; },
                  [](double gamma) { return kPi * (1.0 + std::cos(gamma)) / 2.0; },
                  2.0 * 4.0 * kRadius);
}

TEST(Irradiance, OfACosineLobeIsItsClosedForm) {
  // The slope is at most 1: the maps differ by two radii, under a hemisphere of pi.
  expect_enclosed(
      [](double angle) { return std::max(0.0, std::cos(angle)); },
      [](double gamma) { return 2.0 / 3.0 * ((kPi - gamma) * std::cos(gamma) + std::sin(gamma)); },
      kPi * 2.0 * kRadius);
}

TEST(Irradiance, OfASunDiscIsItsClosedForm) {
  // pi L sin²(sigma) cos(gamma) while the disc is wholly above the horizon, 0 when below.
  constexpr double kSigma = 0.25;
  const auto profile = [](double angle) { return angle < kSigma ? 1.0 : 0.0; };
  for (const double gamma : {0.0, 0.4, 1.0, 1.3}) {
    const auto [low, high] = enclosed(profile, at_angle(gamma, false));
    const double exact = kPi * std::pow(std::sin(kSigma), 2) * std::cos(gamma);
    EXPECT_LE(low, exact) << gamma;
    EXPECT_GE(high, exact) << gamma;
    // They differ within two radii of a circle of circumference 2 pi sin(sigma), to its first
    // order.
    EXPECT_LE(high - low, 1.1 * 4.0 * kRadius * 2.0 * kPi * std::sin(kSigma)) << gamma;
  }
  EXPECT_EQ(enclosed(profile, at_angle(2.0, true)).second, 0.0);
}

TEST(IrradianceBracket, HoldsTheQuadratureAndTheClosedForm) {
  for (const Extent extent : {Extent{1, 1}, {3, 2}, {7, 5}, {10, 5}}) {
    const EnvironmentMap map = random_map_with_sun(extent);
    // What the quadrature itself may be off by: 1e-12 of up to pi.
    const double slack = 4e-12 * sum_of_texels(map);
    for (const Direction normal : trying_normals()) {
      const glm::dvec3 quadrature = reference::irradiance(map, normal);
      const glm::dvec3 closed_form = irradiance(map, normal).rgb;
      for (const int divisions : {0, 1, 3, 6}) {
        const auto [lower, upper] = irradiance_bracket(map, normal, divisions);
        for (int c = 0; c < 3; ++c) {
          EXPECT_LE(lower.rgb[c], quadrature[c] + slack);
          EXPECT_GE(upper.rgb[c], quadrature[c] - slack);
          EXPECT_LE(lower.rgb[c], closed_form[c]);
          EXPECT_GE(upper.rgb[c], closed_form[c]);
        }
      }
    }
  }
}

TEST(IrradianceBracket, NarrowsFourfoldWithEveryDivision) {
  // With the length of a part h, the horizon crosses 1/h of them, of area h², and n·w is up to h
  // there: h² in all. The number of crossed parts wavers by a few, of some 40.
  const EnvironmentMap map = random_map({16, 8});
  for (const Direction normal : {glm::normalize(Direction(1, 2, -3)), Direction(0.6, 0.0, 0.8)}) {
    double before = 0.0;
    for (int divisions = 0; divisions < 7; ++divisions) {
      const auto [lower, upper] = irradiance_bracket(map, normal, divisions);
      const double width = upper.rgb.g - lower.rgb.g;
      if (divisions > 0) {
        EXPECT_GT(before / width, 3.0);
        EXPECT_LT(before / width, 5.0);
      }
      before = width;
    }
    EXPECT_LT(before, 1e-4);
  }
}

TEST(IrradianceBracket, IsOnlyRoundingWhereNothingIsCrossed) {
  const EnvironmentMap map = random_map({16, 8});
  const auto [lower, upper] = irradiance_bracket(map, {0, 0, 1}, 0);
  EXPECT_LT(upper.rgb.r - lower.rgb.r, 1e-12);
  EXPECT_GT(lower.rgb.r, 0.5);
}

}  // namespace
}  // namespace lightproof
