#include "lightproof/prefilter/lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <string>

#include "lightproof/prefilter/lobe_plan.h"
#include "lightproof/prefilter/lobe_samples.h"
#include "lightproof/prefilter/zonal_convolution.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

/// A lobe, and the reference's own density of it, up to a factor.
struct LobeCase {
  std::string name;
  Lobe lobe;
  reference::Lobe exact;
};

std::vector<LobeCase> lobe_cases() {
  return {{"GGX .5", GgxLobe{0.5}, reference::ggx_lobe(0.5)},
          {"GGX .1", GgxLobe{0.1}, reference::ggx_lobe(0.1)},
          {"GGX 1 masked", GgxLobe{1.0, GgxWeight::masking}, reference::ggx_masked_lobe(1.0, 1.0)},
          {"GGX .3 masked, F0 .04", GgxLobe{0.3, GgxWeight::masking, 0.04},
           reference::ggx_masked_lobe(0.3, 0.04)},
          {"Phong 0", PhongLobe{0.0}, reference::phong_lobe(0.0)},
          {"Phong 20.5", PhongLobe{20.5}, reference::phong_lobe(20.5)},
          {"half-vector 0", HalfVectorLobe{0.0}, reference::half_vector_lobe(0.0)},
          {"half-vector 30", HalfVectorLobe{30.0}, reference::half_vector_lobe(30.0)}};
}

/// The integral over the hemisphere of the density times f(cosine), adaptively, in the angle to the
/// axis.
template <class F>
double hemisphere_integral(const reference::Lobe& lobe, const F& f) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 61>;
  const Direction axis = {0.0, 0.0, 1.0};
  return Kronrod::integrate(
      [&](double angle) {
        const Direction light = {std::sin(angle), 0.0, std::cos(angle)};
        return 2.0 * kPi * std::sin(angle) * lobe.value(light, axis) * f(std::cos(angle));
      },
      0.0, 0.5 * kPi, 12, 1e-13);
}

TEST(Lobe, IsTheReferencesDensityUpToAFactor) {
  for (const LobeCase& each : lobe_cases()) {
    const Direction axis = {0.0, 0.0, 1.0};
    const double peak = each.exact.value(axis, axis);
    for (const double angle : {0.0, 0.01, 0.2, 1.0, 1.5}) {
      const Direction light = {std::sin(angle), 0.0, std::cos(angle)};
      // Some roundings of cosines, through powers of up to 30.
      EXPECT_NEAR(relative_density(each.lobe, light.z), each.exact.value(light, axis) / peak, 1e-13)
          << each.name << " at " << angle;
    }
    EXPECT_EQ(relative_density(each.lobe, 0.0), 0.0) << each.name;
    EXPECT_EQ(relative_density(each.lobe, -0.5), 0.0) << each.name;
  }
}

TEST(Lobe, SolidAngleIsItsIntegral) {
  for (const LobeCase& each : lobe_cases()) {
    const Direction axis = {0.0, 0.0, 1.0};
    const double exact =
        hemisphere_integral(each.exact, [](double) { return 1.0; }) / each.exact.value(axis, axis);
    EXPECT_NEAR(solid_angle(each.lobe), exact, 1e-12 * exact) << each.name;
  }
}

TEST(ZonalFactors, AreMeansOfLegendrePolynomials) {
  for (const LobeCase& each : lobe_cases()) {
    const std::vector<double> factors = zonal_factors(each.lobe, 60);
    const double whole = hemisphere_integral(each.exact, [](double) { return 1.0; });
    for (const int l : {0, 1, 2, 3, 10, 31, 60}) {
      const double exact =
          hemisphere_integral(each.exact,
                              [&](double cosine) { return boost::math::legendre_p(l, cosine); }) /
          whole;
      EXPECT_NEAR(factors[static_cast<std::size_t>(l)], exact, 1e-12) << each.name << ", l = " << l;
    }
  }
}

TEST(ZonalFactors, DoNotDependOnTheDegreeAskedFor) {
  const Lobe lobe = GgxLobe{0.05};
  const std::vector<double> few = zonal_factors(lobe, 40);
  const std::vector<double> many = zonal_factors(lobe, kLargestDegree);
  for (std::size_t l = 0; l < few.size(); ++l) EXPECT_NEAR(few[l], many[l], 1e-13) << l;
}

TEST(ZonalFactors, OfTheBroadestGgxLobeAreThoseOfTheClampedCosine) {
  // At alpha = 1 D is constant: what is left is the cosine, whose factors are A_l/pi.
  const std::vector<double> factors = zonal_factors(Lobe(GgxLobe{1.0}), 6);
  const double exact[] = {1.0, 2.0 / 3.0, 0.25, 0.0, -1.0 / 24.0, 0.0, 1.0 / 64.0};
  for (std::size_t l = 0; l <= 6; ++l) EXPECT_NEAR(factors[l], exact[l], 1e-14) << l;
}

TEST(ZonalFactors, OfPhongAreTheClosedForms) {
  for (const double n : {0.0, 1.0, 7.5, 1000.0}) {
    const std::vector<double> factors = zonal_factors(PhongLobe{n}, 3);
    EXPECT_EQ(factors[0], 1.0);
    EXPECT_DOUBLE_EQ(factors[1], (n + 1.0) / (n + 2.0));
    EXPECT_DOUBLE_EQ(factors[2], n / (n + 3.0));
    EXPECT_DOUBLE_EQ(factors[3], (n + 1.0) / (n + 2.0) * (n - 1.0) / (n + 4.0));
  }
}

TEST(LobePlan, LeavesOutNoMoreThanItSays) {
  // The power of what the plan does not hold, from the factors of many more degrees.
  for (const double roughness : {0.2, 0.4, 0.7, 0.9}) {
    const Lobe lobe = GgxLobe{alpha_of_roughness(roughness)};
    const LobePlan plan = plan_lobe(lobe);
    ASSERT_FALSE(plan.local);
    const std::vector<double> all = zonal_factors(lobe, 1500);
    const std::vector<double> cosine = zonal_factors(PhongLobe{1.0}, 1500);
    double whole = 0.0;
    double rest = 0.0;
    for (std::size_t l = 0; l < all.size(); ++l) {
      const double power = (2.0 * static_cast<double>(l) + 1.0) * all[l] * all[l];
      whole += power;
      if (l < plan.factors.size()) continue;
      const double left = all[l] - plan.cosine_share * cosine[l];
      rest += (2.0 * static_cast<double>(l) + 1.0) * left * left;
    }
    // The lobe's kink at the horizon, of slope k, leaves factors that fall off by a power law: of
    // even l, sqrt(8 pi) k l^(-5/2) over the lobe's solid angle, as of a clamped cosine. Their
    // power beyond L is 8 pi/3 k^2 L^(-3). Without it a curvature q is left, whose factors are, of
    // odd l, sqrt(8 pi) q l^(-7/2), and their power beyond L 8 pi/5 q^2 L^(-5).
    const double slope = relative_density(lobe, 1e-6) / 1e-6;
    const double curvature =
        (relative_density(lobe, 2e-4) - 2.0 * relative_density(lobe, 1e-4)) / 1e-8;
    const double bend = plan.cosine_share > 0.0
                            ? std::sqrt(1.0 / 5.0) * std::abs(curvature) * std::pow(256.0, -2.5)
                            : std::sqrt(1.0 / 3.0) * slope * std::pow(256.0, -1.5);
    const double left_out = std::sqrt(8.0 * kPi) * bend / (solid_angle(lobe) * std::sqrt(whole));
    EXPECT_LE(std::sqrt(rest / whole), kHarmonicsTolerance + 1.05 * left_out) << roughness;
  }
}

TEST(LobePlan, SharesOfANarrowLobeAddUpToOne) {
  const LobePlan plan = plan_lobe(GgxLobe{1e-3});
  ASSERT_TRUE(plan.local);
  ASSERT_FALSE(plan.factors.empty());
  EXPECT_GT(plan.local_share, 0.5);
  EXPECT_LT(plan.local->support.value, 0.26);
  // The share that the window keeps near the axis, by adaptive quadrature in the haversine.
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 61>;
  const double reach = plan.local->support.value;
  const double kept = Kronrod::integrate(
      [&](double angle) {
        const double sine = std::sin(0.5 * angle);
        return 2.0 * kPi * std::sin(angle) * plan.local->value(sine * sine);
      },
      0.0, reach, 15, 1e-12);
  EXPECT_NEAR(kept / solid_angle(GgxLobe{1e-3}), plan.local_share, 1e-8) << "the window's own end";
}

// Zonal factors of the sampled lobe against the exact ones. Of N = 2^k Hammersley points the second
// coordinates are the multiples of 1/N: the mean of a function of them is off by at most its total
// variation over N. That of weight times P_l is at most 2 l + 2 times the largest weight, for the
// weight rises and falls once and P_l in [0,1] turns l/2 times; divided by sums of weights, twice
// that.
TEST(LobeSamples, HaveTheZonalFactorsOfTheLobe) {
  constexpr int kCount = 1 << 14;
  for (const LobeCase& each : lobe_cases()) {
    const std::vector<double> factors = zonal_factors(each.lobe, 3);
    for (const LobeSampling sampling :
         {LobeSampling::uniform, LobeSampling::half_vector, LobeSampling::lobe}) {
      const std::vector<LobeSample> samples = lobe_samples(each.lobe, sampling, kCount);
      double largest = 0.0;
      double moments[4] = {};
      for (const LobeSample& sample : samples) {
        largest = std::max(largest, sample.weight * kCount);
        for (int l = 0; l < 4; ++l) {
          moments[l] += sample.weight * boost::math::legendre_p(l, sample.local.z);
        }
      }
      EXPECT_NEAR(moments[0], 1.0, 1e-12) << each.name;
      for (std::size_t l = 1; l < 4; ++l) {
        const double variation = 2.0 * (2.0 * static_cast<double>(l) + 2.0) * largest;
        EXPECT_NEAR(moments[l], factors[l], variation / kCount)
            << each.name << ", l = " << l << ", " << static_cast<int>(sampling);
      }
    }
  }
}

TEST(LobeSamples, InProportionToTheLobeHaveEqualWeights) {
  // Constant in each of 4096 cells of the half-vector's number: the ratio of lobe and half-vectors
  // changes from cell to cell by some 1/4096 of its largest value, save where it nears 0.
  const std::vector<LobeSample> samples = lobe_samples(GgxLobe{0.4}, LobeSampling::lobe, 1024);
  ASSERT_EQ(samples.size(), 1024U) << "none is below the horizon";
  std::vector<double> weights;
  for (const LobeSample& sample : samples) weights.push_back(sample.weight * 1024.0);
  std::sort(weights.begin(), weights.end());
  EXPECT_NEAR(weights[512], 1.0, 1e-3);
  EXPECT_NEAR(weights[51], weights[972], 1e-2) << "nine tenths are alike";
}

TEST(GgxHalfVectors, MirrorTheirShareFromBelowTheHorizon) {
  // N equal steps of the number find a share to 1/N.
  constexpr int kSteps = 100000;
  for (const double alpha : {0.1, 0.5, 1.0}) {
    int below = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = ggx_half_vector_cosine(alpha, (i + 0.5) / kSteps);
      if (2.0 * cosine * cosine < 1.0) ++below;
    }
    EXPECT_NEAR(static_cast<double>(below) / kSteps, alpha * alpha / (1.0 + alpha * alpha),
                1.0 / kSteps);
  }
}

}  // namespace
}  // namespace lightproof
