#include "lightproof/prefilter/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <cmath>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "tests/prefilter/maps.h"

namespace lightproof {
namespace {

/// Boost's complex harmonics, with the Condon-Shortley phase, made real and free of it.
double boost_harmonic(int l, int m, double theta, double phi) {
  const auto order = static_cast<unsigned>(l);
  if (m == 0) return boost::math::spherical_harmonic_r(order, 0, theta, phi);
  const double factor = std::sqrt(2.0) * (m % 2 == 0 ? 1.0 : -1.0);
  return factor * (m > 0 ? boost::math::spherical_harmonic_r(order, m, theta, phi)
                         : boost::math::spherical_harmonic_i(order, -m, theta, phi));
}

Direction direction_at(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

TEST(SphericalHarmonics, AreThoseOfBoost) {
  constexpr int kDegree = 40;
  for (const double theta : {1e-3, 0.3, 1.2, 0.5 * kPi, 2.6}) {
    for (const double phi : {0.1, 1.9, -2.7}) {
      const std::vector<double> values = harmonics_at(direction_at(theta, phi), kDegree);
      for (int l = 0; l <= kDegree; ++l) {
        for (int m = -l; m <= l; ++m) {
          // 40 steps of a stable recurrence, of values up to sqrt(l): 1e-14 a step at most.
          EXPECT_NEAR(values[harmonic_index(l, m)], boost_harmonic(l, m, theta, phi), 4e-13)
              << l << ' ' << m;
        }
      }
    }
  }
}

TEST(SphericalHarmonics, OfDegreeOneAreTheCoordinates) {
  const double scale = std::sqrt(3.0 / (4.0 * kPi));
  for (const Direction d : trying_normals()) {
    const std::vector<double> values = harmonics_at(d, 1);
    EXPECT_NEAR(values[0], std::sqrt(1.0 / (4.0 * kPi)), 1e-15);
    EXPECT_NEAR(values[harmonic_index(1, -1)], scale * d.y, 1e-15);
    EXPECT_NEAR(values[harmonic_index(1, 0)], scale * d.z, 1e-15);
    EXPECT_NEAR(values[harmonic_index(1, 1)], scale * d.x, 1e-15);
  }
}

TEST(SphericalHarmonics, AtAPoleAreFiniteAndOnlyThoseWithoutLongitude) {
  for (const Direction pole : {Direction(0, 0, 1), Direction(0, 0, -1)}) {
    const std::vector<double> values = harmonics_at(pole, 300);
    for (int l = 0; l <= 300; ++l) {
      const double sign = pole.z < 0.0 && l % 2 == 1 ? -1.0 : 1.0;
      const double largest = std::sqrt((2 * l + 1) / (4.0 * kPi));
      EXPECT_NEAR(values[harmonic_index(l, 0)], sign * largest, 1e-12 * largest);
      if (l == 0) continue;
      EXPECT_EQ(values[harmonic_index(l, l)], 0.0);
    }
  }
}

/// ∫ Y(l,m) d(omega) over a texel by Gauss's rule of 30 x 30 nodes on Boost's harmonics: for texels
/// and degrees as here exact but for rounding.
double texel_integral(Extent extent, int x, int y, int l, int m) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const auto row = [&](double t) {
    const double theta = kPi - kPi * t;
    const auto column = [&](double s) { return boost_harmonic(l, m, theta, kPi - 2.0 * kPi * s); };
    return 2.0 * kPi * kPi * std::sin(theta) *
           Rule::integrate(column, static_cast<double>(x) / extent.width, (x + 1.0) / extent.width);
  };
  return Rule::integrate(row, static_cast<double>(y) / extent.height, (y + 1.0) / extent.height);
}

TEST(Projection, OfATexelIsItsQuadrature) {
  constexpr int kDegree = 8;
  for (const Extent extent : {Extent{1, 1}, {3, 2}, {5, 7}}) {
    for (int y = 0; y < extent.height; ++y) {
      for (const int x : {0, extent.width - 1}) {
        const SphericalHarmonics actual = project(one_lit_texel(extent, x, y), kDegree);
        for (int l = 0; l <= kDegree; ++l) {
          for (int m = -l; m <= l; ++m) {
            EXPECT_NEAR(actual(l, m).r, texel_integral(extent, x, y, l, m), 1e-13)
                << extent.width << 'x' << extent.height << ' ' << x << ' ' << y << ", " << l << ' '
                << m;
          }
        }
      }
    }
  }
}

TEST(Projection, IsLinearInEachChannel) {
  const EnvironmentMap map = random_map({9, 6});
  const SphericalHarmonics whole = project(map, 3);
  SphericalHarmonics sum = project({"black", Grid<Rgb>({9, 6}), {}}, 3);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 9; ++x) {
      const SphericalHarmonics texel = project(one_lit_texel({9, 6}, x, y), 3);
      for (std::size_t i = 0; i < sum.coefficients.size(); ++i) {
        sum.coefficients[i] += texel.coefficients[i] * glm::dvec3(map.radiance(x, y));
      }
    }
  }
  for (std::size_t i = 0; i < sum.coefficients.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(whole.coefficients[i][c], sum.coefficients[i][c], 1e-13);
    }
  }
}

TEST(Projection, OfHighDegreeAndOneRowIsStillExact) {
  // L = 1 has only the first one; the row is half a turn, in many panels.
  const EnvironmentMap map{"constant", Grid<Rgb>({1, 1}, Rgb(1.0F)), {}};
  const SphericalHarmonics actual = project(map, 200);
  EXPECT_NEAR(actual(0, 0).r, std::sqrt(4.0 * kPi), 1e-13);
  for (std::size_t i = 1; i < actual.coefficients.size(); ++i) {
    EXPECT_NEAR(actual.coefficients[i].r, 0.0, 1e-12);
  }
}

TEST(Projection, HasTheSameBitsForAnyNumberOfThreads) {
  const EnvironmentMap map = random_map({40, 37});
  const auto bits = [&](int threads) {
    const ThreadLimit limit(threads);
    return project(map, 7).coefficients;
  };
  EXPECT_EQ(bits(1), bits(3));
}

TEST(Projection, RefusesDegreesThatItCannotTake) {
  const EnvironmentMap map = random_map({4, 2});
  EXPECT_THROW(project(map, -1), InputError);
  EXPECT_THROW(project(map, kLargestHarmonicDegree + 1), InputError);
  EXPECT_THROW(harmonics_at({0, 0, 1}, -1), InputError);
}

TEST(ClampedCosineFactor, IsPublishedAsTheseNumbers) {
  const double expected[] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0, 0.0, -kPi / 24.0, 0.0, kPi / 64.0};
  for (int l = 0; l <= 6; ++l) EXPECT_NEAR(clamped_cosine_factor(l), expected[l], 1e-15) << l;
}

TEST(ClampedCosineFactor, IsTheIntegralWithLegendresPolynomial) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (int l = 0; l <= 40; ++l) {
    const double integral =
        2.0 * kPi *
        Rule::integrate([l](double c) { return c * boost::math::legendre_p(l, c); }, 0.0, 1.0);
    EXPECT_NEAR(clamped_cosine_factor(l), integral, 1e-13) << l;
  }
}

TEST(Irradiance, OfNineHarmonicsIsThePublishedQuadraticForm) {
  // Ramamoorthi & Hanrahan 2001, equation 13; its constants have six digits.
  const SphericalHarmonics light = project(random_map({16, 8}), 2);
  const auto c = [&](int l, int m) { return light(l, m).r; };
  for (const Direction n : trying_normals()) {
    const double quadratic =
        0.429043 * c(2, 2) * (n.x * n.x - n.y * n.y) + 0.743125 * c(2, 0) * n.z * n.z +
        0.886227 * c(0, 0) - 0.247708 * c(2, 0) +
        2 * 0.429043 * (c(2, -2) * n.x * n.y + c(2, 1) * n.x * n.z + c(2, -1) * n.y * n.z) +
        2 * 0.511664 * (c(1, 1) * n.x + c(1, -1) * n.y + c(1, 0) * n.z);
    double sum = 0.0;
    for (const glm::dvec3 coefficient : light.coefficients) sum += std::abs(coefficient.r);
    EXPECT_NEAR(evaluate(irradiance_harmonics(light), n).r, quadratic, 1e-6 * sum);
  }
}

TEST(Irradiance, ByHarmonicsOfAMapIsThatOfEachNormal) {
  const SphericalHarmonics light = irradiance_harmonics(project(random_map({16, 8}), 9));
  const Extent normals = {7, 5};
  const IrradianceMap map = irradiance_map(light, normals);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const glm::dvec3 expected = evaluate(light, normal_of_texel(normals, x, y));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(map.irradiance(x, y)[c], expected[c], 1e-13);
    }
  }
  EXPECT_THROW(irradiance_map(light, {0, 1}), InputError);
}

/// Normals whose weighted sum is the mean over the sphere of harmonics up to degree 79.
struct SphereRule {
  std::vector<Direction> normals;
  std::vector<double> weights;

  SphereRule() {
    using Rule = boost::math::quadrature::gauss<double, 40>;
    constexpr int kAzimuths = 80;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      for (const double z : {Rule::abscissa()[i], -Rule::abscissa()[i]}) {
        for (int k = 0; k < kAzimuths; ++k) {
          normals.push_back(direction_at(std::acos(z), 2.0 * kPi * k / kAzimuths));
          weights.push_back(0.5 * Rule::weights()[i] / kAzimuths);
        }
      }
    }
  }
};

TEST(Irradiance, ExactlyAndByHarmonicsDifferByWhatTheTruncationOmits) {
  const EnvironmentMap map = random_map_with_sun({16, 8});
  constexpr int kHigh = 60;
  const SphericalHarmonics light = project(map, kHigh);
  const double whole = light(0, 0).r * std::sqrt(4.0 * kPi);  // ∫ L
  const double beyond = irradiance_truncation(kHigh).root_mean_square * whole;
  const SphereRule rule;
  const std::vector<Irradiance> exact = irradiances(map, rule.normals);
  for (const int degree : {0, 1, 2, 4}) {
    const SphericalHarmonics kept = irradiance_harmonics(project(map, degree));
    double square = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double difference = exact[i].rgb.r - evaluate(kept, rule.normals[i]).r;
      square += rule.weights[i] * difference * difference;
    }
    // What lies beyond degree 60 is missing in the prediction and aliased in the measurement.
    const double predicted = omitted_irradiance(light, degree).r;
    EXPECT_NEAR(std::sqrt(square), predicted, 2.0 * beyond) << degree;
    EXPECT_LE(predicted, irradiance_truncation(degree).root_mean_square * whole * (1 + 1e-12));
    EXPECT_GT(predicted, 20.0 * beyond) << "too little to tell";
  }
}

/// The remainder of the clamped cosine at c = n·d, of light from d alone, of power 1.
double remainder_of_delta(int degree, double c) {
  double sum = 0.0;
  for (int l = 0; l <= degree; ++l) {
    sum += (2 * l + 1) / (4.0 * kPi) * clamped_cosine_factor(l) * boost::math::legendre_p(l, c);
  }
  return std::max(c, 0.0) - sum;
}

TEST(Truncation, OfNineHarmonicsIsAsKnown) {
  const HarmonicTruncation nine = irradiance_truncation(2);
  EXPECT_NEAR(nine.largest, 3.0 / 32.0, 1e-15);
  EXPECT_NEAR(nine.root_mean_square, 1.0 / std::sqrt(768.0), 1e-15);
}

TEST(Truncation, IsThatOfOneDirectionOfLight) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  for (int degree = 0; degree <= 20; ++degree) {
    const auto [largest, root_mean_square] = irradiance_truncation(degree);
    double seen = 0.0;
    constexpr int kSteps = 2000;
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double at = std::abs(remainder_of_delta(degree, static_cast<double>(i) / kSteps));
      seen = std::max(seen, at);
    }
    EXPECT_NEAR(seen, largest, 1e-12) << degree;
    const auto square = [&](double c) { return std::pow(remainder_of_delta(degree, c), 2); };
    const double mean =
        0.5 * (Rule::integrate(square, -1.0, 0.0) + Rule::integrate(square, 0.0, 1.0));
    EXPECT_NEAR(std::sqrt(mean), root_mean_square, 1e-12) << degree;
  }
}

TEST(Truncation, IsAttainedByNineHarmonicsOfADelta) {
  const Direction light = glm::normalize(Direction(1, -2, 2));
  const std::vector<double> values = harmonics_at(light, 2);
  SphericalHarmonics delta{2, {}};
  for (const double value : values) delta.coefficients.emplace_back(value);
  const SphericalHarmonics nine = irradiance_harmonics(delta);
  const Frame frame = frame_around(light);
  // 0 at the horizon, where nine harmonics give 3/32.
  EXPECT_NEAR(evaluate(nine, frame.tangent).r, 3.0 / 32.0, 1e-15);
  for (int i = 0; i <= 64; ++i) {
    const double gamma = kPi * i / 64.0;
    const Direction normal = std::cos(gamma) * light + std::sin(gamma) * frame.bitangent;
    const double error = evaluate(nine, normal).r - std::max(0.0, std::cos(gamma));
    EXPECT_LE(std::abs(error), 3.0 / 32.0 + 1e-15);
  }
}

TEST(Truncation, BoundsTheErrorOfOneBrightTexelAndNearlyIsIt) {
  const Extent source = {512, 256};
  const EnvironmentMap map = one_lit_texel(source, 100, 200, 1e5F);
  const double whole = 1e5 * texel_solid_angle(source, 200);
  const Extent normals = {64, 32};
  const IrradianceMap exact = irradiance_map(map, normals);
  const IrradianceError error =
      error_of(irradiance_map(irradiance_harmonics(project(map, 2)), normals), exact);
  // Errors are relative to the mean of E, whole/4.
  EXPECT_LE(error.largest, 4.0 * 3.0 / 32.0 * (1.0 + 1e-9));
  // A normal within half a step of the map, 0.05, of the horizon: |c|/2 less; and the texel's own
  // radius 0.01.
  EXPECT_GE(error.largest, 4.0 * (3.0 / 32.0 - 0.5 * 0.06));
  // The mean square over 64 x 32 normals is that over the sphere, to 1 %.
  EXPECT_NEAR(error.root_mean_square, 4.0 / std::sqrt(768.0), 0.01 * 4.0 / std::sqrt(768.0));
  EXPECT_GT(whole, 0.0);
}

}  // namespace
}  // namespace lightproof
