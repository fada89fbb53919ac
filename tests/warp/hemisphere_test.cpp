#include "lightproof/warp/hemisphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightproof {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();

TEST(CosinePower, AgreesWithPowForWholeExponents) {
  for (const double n : {0.0, 1.0, 2.0, 3.0, 50.0, 127.0, 1000.0, 1024.0, 1025.0, 100000.0}) {
    for (const double cosine : {0.0, 0.01, 0.5, 0.93, 0.999, 1.0}) {
      const double expected = std::pow(cosine, n);
      EXPECT_NEAR(cosine_power(cosine, n), expected, std::max(1.0, n) * kUlp * expected)
          << cosine << "^" << n;
    }
  }
}

TEST(CosinePower, TakesFractionalExponents) {
  for (const double n : {0.5, 1.5, 50.25, 1e-3}) {
    EXPECT_EQ(cosine_power(0.7, n), std::pow(0.7, n));
  }
}

// No warp gives a direction on the horizon or below it.
TEST(HemispherePdf, IsZeroOnTheHorizonAndBelow) {
  for (const double z : {0.0, -1e-300, -0.5, -1.0}) {
    const Direction d = {std::sqrt(1.0 - z * z), 0.0, z};
    EXPECT_EQ(uniform_hemisphere_pdf(d).value, 0.0);
    EXPECT_EQ(cosine_hemisphere_pdf(d).value, 0.0);
    EXPECT_EQ(phong_lobe_pdf(z, 0.0).value, 0.0);
    EXPECT_EQ(phong_lobe_pdf(z, 3.0).value, 0.0);
  }
  EXPECT_EQ(uniform_hemisphere_pdf({1.0, 0.0, 1e-300}).value, 1.0 / (2.0 * kPi));
}

// Counterclockwise from +x, once around.
TEST(HemisphereWarps, TurnAroundThePoleOnce) {
  for (const double s : {0.0, 0.125, 0.25, 0.6, 0.75, 0.999}) {
    const double phi = 2.0 * kPi * s;
    for (const Direction d :
         {uniform_hemisphere_from_square({s, 0.3}), cosine_hemisphere_from_square({s, 0.3}),
          phong_lobe_from_square({s, 0.3}, 20.0)}) {
      const double radius = std::hypot(d.x, d.y);
      EXPECT_NEAR(d.x, radius * std::cos(phi), 8 * kUlp);
      EXPECT_NEAR(d.y, radius * std::sin(phi), 8 * kUlp);
    }
  }
}

TEST(HemisphereWarps, GiveUnitVectorsAboveTheHorizonAndThePole) {
  for (const double s : {0.0, 0.3, 0.999}) {
    for (const double t : {0.0, 0.25, 0.999999}) {
      const Direction diffuse = cosine_hemisphere_from_square({s, t});
      const Direction lobe = phong_lobe_from_square({s, t}, 50.0);
      EXPECT_NEAR(glm::length(diffuse), 1.0, 4 * kUlp);
      EXPECT_NEAR(glm::length(lobe), 1.0, 4 * kUlp);
      EXPECT_GT(diffuse.z, 0.0);
      EXPECT_GT(lobe.z, 0.0);
    }
  }
  EXPECT_EQ(cosine_hemisphere_from_square({0.3, 0.0}).z, 1.0);
  EXPECT_EQ(phong_lobe_from_square({0.3, 0.0}, 50.0).z, 1.0);
}

/// The share of the density inside the cone of u.t must be u.t: integral over the cosine by
/// midpoints, whose error is below (1/steps)^2 times the second derivative, n^3.
TEST(HemisphereWarps, HoldTheMassThatTheirDensityGives) {
  constexpr int kSteps = 100000;
  for (const double t : {0.1, 0.5, 0.9}) {
    for (const double n : {1.0, 10.0}) {
      const double edge = phong_lobe_from_square({0.0, t}, n).z;
      double mass = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double cosine = edge + (1.0 - edge) * (i + 0.5) / kSteps;
        mass += 2.0 * kPi * phong_lobe_pdf(cosine, n).value * (1.0 - edge) / kSteps;
      }
      EXPECT_NEAR(mass, t, 1e-7) << "exponent " << n;
    }
    EXPECT_EQ(uniform_hemisphere_from_square({0.4, t}).z, 1.0 - t);
    // The cosine hemisphere is the lobe with n = 1.
    EXPECT_NEAR(cosine_hemisphere_from_square({0.2, t}).z, phong_lobe_from_square({0.2, t}, 1.0).z,
                4 * kUlp);
  }
  EXPECT_DOUBLE_EQ(uniform_hemisphere_pdf({0.6, 0.0, 0.8}).value, phong_lobe_pdf(0.8, 0.0).value);
  EXPECT_EQ(uniform_hemisphere_pdf({0.6, 0.0, -0.8}).value, 0.0);
  EXPECT_DOUBLE_EQ(cosine_hemisphere_pdf({0.6, 0.0, 0.8}).value, phong_lobe_pdf(0.8, 1.0).value);
}

}  // namespace
}  // namespace lightproof
