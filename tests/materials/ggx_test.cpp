#include "lightproof/materials/ggx.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace lightproof {
namespace {

using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;

constexpr double kRoughnesses[] = {0.01, 0.1, 0.3, 0.6, 1.0};
constexpr double kCosines[] = {1.0, 0.7, 0.17, 0.00175};
/// To which the rules below are asked to agree, with room for two of them nested.
constexpr double kQuadrature = 1e-7;

Direction normal_at(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// ∫ f(h) dh over the upper hemisphere; in tan(beta) = tan(theta) / alpha, in which GGX's lobe is
/// equally wide for every alpha.
template <class Integrand>
double over_normals(double alpha, const Integrand& f) {
  return Rule::integrate(
      [&](double beta) {
        const double theta = std::atan(alpha * std::tan(beta));
        const double slope =
            alpha / (std::pow(std::cos(beta), 2) + std::pow(alpha * std::sin(beta), 2));
        return f(theta) * std::sin(theta) * slope;
      },
      0.0, 0.5 * kPi, 8, 1e-9);
}

TEST(GgxNormalDistribution, HasTheProjectedAreaOfTheSurface) {
  for (const double roughness : kRoughnesses) {
    const double alpha = ggx_alpha(roughness);
    const double area = over_normals(alpha, [&](double theta) {
      return 2.0 * kPi * ggx_normal_distribution(alpha, normal_at(theta, 0.0)) * std::cos(theta);
    });
    EXPECT_NEAR(area, 1.0, kQuadrature) << roughness;
  }
}

TEST(GgxNormalDistribution, IsUniformAtRoughnessOneAndZeroBelowTheSurface) {
  for (const double theta : {0.0, 0.5, 1.5}) {
    EXPECT_NEAR(ggx_normal_distribution(1.0, normal_at(theta, 1.0)), 1.0 / kPi, 1e-15);
    EXPECT_EQ(ggx_normal_distribution(0.3, -normal_at(theta, 1.0)), 0.0);
  }
}

// Walter et al. 2007, eq. 33, in the tangent.
TEST(GgxNormalDistribution, IsThatOfTheTangent) {
  for (const double roughness : kRoughnesses) {
    const double a2 = std::pow(roughness, 4);
    for (const double in_alphas : {0.0, 0.5, 1.0, 3.0}) {
      const double theta = std::atan(in_alphas * std::sqrt(a2));
      const double cosine = std::cos(theta);
      const double t2 = std::pow(std::tan(theta), 2);
      const double expected = a2 / (kPi * std::pow(cosine, 4) * std::pow(a2 + t2, 2));
      EXPECT_NEAR(ggx_normal_distribution(std::sqrt(a2), normal_at(theta, 0.3)) / expected, 1.0,
                  1e-12);
    }
  }
}

// What the view sees of the microfacets is the surface: G1(v) ∫ (v.h)+ D(h) dh = n.v (Heitz 2014,
// eq. 14 with Smith's G1). The azimuths that face the view end where v.h = 0.
TEST(SmithMasking, SeesTheProjectedAreaOfTheSurface) {
  for (const double roughness : kRoughnesses) {
    const double alpha = ggx_alpha(roughness);
    for (const double mu : kCosines) {
      const double sine = std::sqrt((1.0 - mu) * (1.0 + mu));
      const double seen = over_normals(alpha, [&](double theta) {
        const double along = mu * std::cos(theta);
        const double across = sine * std::sin(theta);
        const double last = along >= across ? kPi : std::acos(-along / across);
        // ∫ (along + across cos(phi)) dphi from -last to last
        return ggx_normal_distribution(alpha, normal_at(theta, 0.0)) * 2.0 *
               (along * last + across * std::sin(last));
      });
      EXPECT_NEAR(smith_masking(alpha, mu) * seen / mu, 1.0, kQuadrature)
          << roughness << ", " << mu;
    }
  }
}

TEST(SmithMaskingShadowing, IsTheProductOfMaskingsWhereSeparable) {
  for (const double alpha : {1e-4, 0.09, 0.5, 1.0}) {
    for (const double v : kCosines) {
      for (const double l : kCosines) {
        const double product = smith_masking(alpha, v) * smith_masking(alpha, l);
        EXPECT_NEAR(smith_masking_shadowing(SmithMasking::separable, alpha, v, l), product,
                    1e-14 * product);
      }
    }
  }
}

TEST(SmithMaskingShadowing, IsThatOfHeightWhereCorrelated) {
  for (const double alpha : {1e-4, 0.09, 0.5, 1.0}) {
    for (const double v : kCosines) {
      for (const double l : kCosines) {
        // 1/(1 + Lambda(v) + Lambda(l)), where G1 = 1/(1 + Lambda).
        const double inverse = 1.0 / smith_masking(alpha, v) + 1.0 / smith_masking(alpha, l) - 1.0;
        const double g2 = smith_masking_shadowing(SmithMasking::height_correlated, alpha, v, l);
        EXPECT_NEAR(g2, 1.0 / inverse, 1e-14);
        EXPECT_GE(g2 * (1.0 + 1e-14),
                  smith_masking_shadowing(SmithMasking::separable, alpha, v, l));
        EXPECT_LE(g2, std::min(smith_masking(alpha, v), smith_masking(alpha, l)) + 1e-14);
      }
    }
  }
}

// k = R^2/2: at R = 1 and a right angle of 60 degrees, 1/2 / (1/4 + 1/2).
TEST(SmithMaskingShadowing, OfKarisIsHisRationalForm) {
  EXPECT_NEAR(smith_masking_shadowing(SmithMasking::karis, 1.0, 0.5, 1.0), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(smith_masking_shadowing(SmithMasking::karis, 1.0, 0.5, 0.5), 4.0 / 9.0, 1e-15);
  const double k = 0.5 * ggx_alpha(0.6);
  const double g = [&](double mu) { return mu / (mu * (1.0 - k) + k); }(0.3);
  EXPECT_NEAR(smith_masking_shadowing(SmithMasking::karis, ggx_alpha(0.6), 0.3, 0.3), g * g, 1e-15);
}

TEST(SmithMaskingShadowing, HidesNothingOfASmoothSurface) {
  for (const SmithMasking masking :
       {SmithMasking::karis, SmithMasking::separable, SmithMasking::height_correlated}) {
    EXPECT_NEAR(smith_masking_shadowing(masking, ggx_alpha(0.01), 0.5, 0.7), 1.0, 1e-3);
    EXPECT_NEAR(smith_masking_shadowing(masking, ggx_alpha(0.5), 1.0, 1.0), 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace lightproof
