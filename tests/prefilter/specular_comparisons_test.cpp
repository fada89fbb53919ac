#include "lightproof/prefilter/specular_comparisons.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/lobe.h"

namespace lightproof {
namespace {

using Kronrod = boost::math::quadrature::gauss_kronrod<double, 61>;

/// 1/4 of the integral of D G over the hemisphere, D = (S+2)/2pi (n·h)^S.
template <class Geometry>
double white_by_quadrature(double shininess, const Geometry& geometry) {
  const auto integrand = [&](double cosine) {
    const double half = std::sqrt(0.5 * (1.0 + cosine));
    const double distribution = (shininess + 2.0) / (2.0 * kPi) * std::pow(half, shininess);
    return 0.25 * 2.0 * kPi * distribution * geometry(cosine);
  };
  // In two parts, for the kink of min(1, 2c).
  return Kronrod::integrate(integrand, 0.0, 0.5, 12, 1e-13) +
         Kronrod::integrate(integrand, 0.5, 1.0, 12, 1e-13);
}

TEST(WhiteMap, ByEachGeometryTermIsItsIntegral) {
  for (const double shininess : {0.0, 1.0, 4.3, 30.0, 500.0}) {
    EXPECT_NEAR(white_without_geometry(shininess),
                white_by_quadrature(shininess, [](double) { return 1.0; }), 1e-11);
    EXPECT_NEAR(white_with_cosine_geometry(shininess),
                white_by_quadrature(shininess, [](double c) { return 2.0 * c; }), 1e-11);
    EXPECT_NEAR(white_with_cook_torrance(shininess),
                white_by_quadrature(shininess, [](double c) { return std::min(1.0, 2.0 * c); }),
                1e-11);
  }
}

TEST(WhiteMap, WithTheCosineAsGeometryHasThePrintedValues) {
  EXPECT_NEAR(white_with_cosine_geometry(0.0), 0.5, 1e-15);
  EXPECT_NEAR(white_with_cosine_geometry(30.0), 1.765, 5e-4);
  EXPECT_NEAR(white_with_cosine_geometry(1e6), 2.0, 1e-5) << "twice the light that comes in";
  EXPECT_LE(white_with_cook_torrance(30.0), 1.0);
}

TEST(Comparisons, OfTheShareOfDrawsThatMissHaveThePrintedValues) {
  EXPECT_NEAR(1.0 - white_without_geometry(half_vector_shininess(0.5)), 1.0 - 0.99998, 1e-5);
  EXPECT_NEAR(white_without_geometry(half_vector_shininess(0.75)), 0.8882, 5e-5);
  EXPECT_NEAR(white_without_geometry(half_vector_shininess(1.0)), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(ggx_below_horizon(1.0), 0.5);
  EXPECT_EQ(skipped_share(0.0), 0.0);
}

TEST(Comparisons, OfTheHalfVectorDensityIntegrateIt) {
  const auto integral = [](double factor, double shininess) {
    return Kronrod::integrate(
        [&](double cosine) {
          return 2.0 * kPi * factor * (shininess + 1.0) * std::pow(cosine, shininess);
        },
        0.0, 1.0, 12, 1e-13);
  };
  const PublishedComparison result = half_vector_density_comparison();
  EXPECT_NEAR(result.published, integral(1.0, 7.0), 1e-12);
  EXPECT_NEAR(result.corrected, integral(1.0 / (2.0 * kPi), 7.0), 1e-12);
}

TEST(Comparisons, OfTheFresnelTermIntegrateItUnderTheIntegral) {
  // Without roughness there is one half-vector, and nothing to take out of the integral.
  const PublishedComparison smooth = fresnel_at_mirror_comparison(0.04, 0.3, 0.001);
  EXPECT_NEAR(smooth.published, smooth.exact, 1e-4 * smooth.exact);
  // At F0 = 1 the Fresnel term is 1 everywhere.
  const PublishedComparison metal = fresnel_at_mirror_comparison(1.0, 0.3, 0.7);
  EXPECT_NEAR(metal.published, metal.exact, 1e-12);
  // A rough surface seen at grazing angles: half-vectors lean towards the view, and reflect less
  // than the mirrored direction.
  const PublishedComparison rough = fresnel_at_mirror_comparison(0.04, 0.1, 0.7);
  EXPECT_GT(rough.published, 1.5 * rough.exact);
  const ScaleBias split = integrate_brdf(0.1, 0.7, Masking::height_correlated);
  EXPECT_DOUBLE_EQ(rough.exact, 0.04 * split.scale + split.bias);
}

TEST(Comparisons, SaySomethingOfEverySystem) {
  std::set<std::string> systems;
  for (const PublishedComparison& each : specular_comparisons()) {
    systems.emplace(each.system);
    EXPECT_NE(each.published, each.exact) << each.what;
    EXPECT_LE(std::abs(each.corrected - each.exact), std::abs(each.published - each.exact))
        << each.what;
    EXPECT_FALSE(each.what.empty());
  }
  const std::set<std::string> all = {"002-5", "002-6", "004-1", "004-4",  "004-5", "004-6",
                                     "004-7", "004-8", "004-9", "004-10", "004-14"};
  EXPECT_EQ(systems, all);
}

}  // namespace
}  // namespace lightproof
