#include "reference/microfacet_reflectance.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <limits>

namespace lightproof::reference {
namespace {

using Kind = NormalDistribution::Kind;

constexpr double kQuadrature = 1e-6;

RoughMirror ggx(double roughness, Masking masking) {
  return {{Kind::ggx, roughness * roughness}, masking};
}

TEST(SplitSum, OfRoughnessOneSeenFromTheNormalReflectsOneLessLogTwo) {
  for (const Masking masking :
       {Masking::smith_karis, Masking::smith_separable, Masking::smith_height_correlated}) {
    EXPECT_NEAR(split_sum(ggx(1.0, masking), 1.0).white(), 1.0 - std::log(2.0), kQuadrature);
  }
}

// One integral over the cosine c of the light is left: 4 alpha^2/((alpha^2-1) c + alpha^2 + 1)^2
// times c/(c + sqrt(c^2 + alpha^2 (1 - c^2))).
TEST(SplitSum, SeenFromTheNormalIsASingleIntegral) {
  for (const double roughness : {0.01, 0.1, 0.25, 0.3, 0.5, 0.6, 0.75, 1.0}) {
    const double a2 = std::pow(roughness, 4);
    boost::math::quadrature::tanh_sinh<double> rule;
    // From 1 - c, in which narrow lobes keep their digits.
    const double exact = rule.integrate(
        [&](double from_normal) {
          const double c = 1.0 - from_normal;
          const double d = from_normal + a2 * (1.0 + c);
          return 4.0 * a2 / (d * d) * c / (c + std::sqrt(c * c + a2 * (1.0 - c * c)));
        },
        0.0, 1.0);
    EXPECT_NEAR(split_sum(ggx(roughness, Masking::smith_separable), 1.0).white(), exact,
                kQuadrature);
    EXPECT_NEAR(split_sum(ggx(roughness, Masking::smith_height_correlated), 1.0).white(), exact,
                kQuadrature);
  }
}

TEST(SplitSum, SeenFromTheNormalHasItsPrintedValues) {
  const auto white = [](double roughness) {
    return split_sum(ggx(roughness, Masking::smith_height_correlated), 1.0).white();
  };
  EXPECT_NEAR(white(0.25), .99569, 5e-6 + kQuadrature);
  EXPECT_NEAR(white(0.5), .91581, 5e-6 + kQuadrature);
  EXPECT_NEAR(white(0.75), .62689, 5e-6 + kQuadrature);
}

struct Row {
  double roughness;
  double mu;
  double scale;
  double bias;
};

void expect_rows(Masking masking, std::initializer_list<Row> rows) {
  for (const Row& row : rows) {
    const SplitSum found = split_sum(ggx(row.roughness, masking), row.mu);
    EXPECT_NEAR(found.scale, row.scale, 1e-4) << row.roughness << ", " << row.mu;
    EXPECT_NEAR(found.bias, row.bias, 1e-4) << row.roughness << ", " << row.mu;
  }
}

// As computed elsewhere, to the digits shown.
TEST(SplitSum, IsThatOfTables) {
  expect_rows(Masking::smith_height_correlated, {{0.25, 0.1, .5052, .3916},
                                                 {0.25, 0.5, .9557, .0326},
                                                 {0.25, 1.0, .9957, 0.0},
                                                 {0.5, 0.1, .7520, .1397},
                                                 {0.5, 0.5, .8349, .0224},
                                                 {0.5, 1.0, .9158, 0.0},
                                                 {0.75, 0.1, .7958, .0526},
                                                 {0.75, 0.5, .6547, .0085},
                                                 {0.75, 1.0, .6268, 0.0},
                                                 {1.0, 0.1, .7364, .0239},
                                                 {1.0, 0.5, .4477, .0030},
                                                 {1.0, 1.0, .3068, 0.0}});
  expect_rows(Masking::smith_karis, {{0.25, 0.1, .3913, .2911},
                                     {0.25, 0.5, .9023, .0305},
                                     {0.25, 1.0, .9943, 0.0},
                                     {0.5, 0.1, .5902, .0984},
                                     {0.5, 0.5, .7285, .0186},
                                     {0.5, 1.0, .8950, 0.0},
                                     {0.75, 0.1, .6409, .0353},
                                     {0.75, 0.5, .5730, .0070},
                                     {0.75, 1.0, .6036, 0.0},
                                     {1.0, 0.1, .5444, .0136},
                                     {1.0, 0.5, .4067, .0025},
                                     {1.0, 1.0, .3068, 0.0}});
}

// A mirror's Fresnel factor is left, and no masking.
TEST(SplitSum, OfASmoothSurfaceIsTheFresnelFactor) {
  for (const double mu : {0.2, 0.5, 1.0}) {
    const SplitSum found = split_sum(ggx(0.01, Masking::smith_height_correlated), mu);
    const double bias = std::pow(1.0 - mu, 5.0);
    // alpha = 1e-4 spreads v.h by as much, and the light's cosine.
    EXPECT_NEAR(found.bias, bias, 1e-6);
    EXPECT_NEAR(found.scale, 1.0 - bias, 1e-5);
    EXPECT_NEAR(found.of(0.04), 0.04 + 0.96 * bias, 1e-5);
  }
}

// S = 0 seen from the normal: D = 1/pi, and with x = (n.h)^2 = (v.h)^2 the light's cosine is 2x - 1
// and G = min(1, 4x - 2). Over x from 1/2, where light comes along the surface, to 1: 1/8 up to
// 3/4, and 1/4 from there.
TEST(SplitSum, OfUniformNormalsBetweenGroovesIsThreeEighths) {
  EXPECT_NEAR(split_sum({{Kind::blinn, 0.0}, Masking::v_grooves}, 1.0).white(), 0.375, kQuadrature);
}

TEST(SplitSum, OfBlinnsLobeLosesNothingWhereItIsNarrow) {
  for (const double mu : {0.5, 1.0}) {
    EXPECT_NEAR(split_sum({{Kind::blinn, 2e4 - 2.0}, Masking::v_grooves}, mu).white(), 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace lightproof::reference
