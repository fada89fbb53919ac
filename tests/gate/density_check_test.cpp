// A pdf against the declared density: what is unlit, unreachable or off is found in one texel of
// thousands.
#include "lightproof/gate/density_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/image/synthetic.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

constexpr TargetDensity kTarget = {DensitySpace::solid_angle, kRec709};

/// A sampler of the map's own masses but for one texel's.
BoundSampler with_mass(const EnvironmentMap& map, int x, int y, double factor) {
  Grid<double> masses = reference::texel_masses(map, kTarget);
  const double other = masses(x, y) * factor;
  const double rest = (1.0 - other) / (1.0 - masses(x, y));
  for (double& mass : masses.values()) mass *= rest;
  masses(x, y) = other;
  return bound(DiscreteSampler(std::move(masses), kTarget.density_space));
}

TEST(DensityCheck, ACorrectPdfIsTheDeclaredDensity) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
    const TargetDensity target = {density_space, kRec709};
    const auto sampler =
        bound(DiscreteSampler(reference::texel_masses(map, target), density_space));
    const DensityComparison density = compare_density(sampler, expectation_of(map, target), {});
    EXPECT_TRUE(check_support(density).passed);
    EXPECT_TRUE(check_declared_density(density).passed);
    EXPECT_LT(density.largest_error, 1e-12);
    EXPECT_TRUE(density.ratio.is_constant());
    EXPECT_FALSE(density.times_jacobian.is_constant());
    EXPECT_FALSE(density.over_other_measure.is_constant());
  }
}

// One density's pdf where another with the same texels is declared: at the centres of texels they
// differ by (pi/2H)^2/6 = 4e-4, and by one factor.
TEST(DensityCheck, APdfThatIsUniformInTheOtherMeasureIsKnown) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const TargetDensity b = {DensitySpace::solid_angle};
  const TargetDensity c = {DensitySpace::sine_weighted};
  for (const auto& [declared, claimed] : {std::pair(b, c), std::pair(c, b)}) {
    const auto sampler =
        bound(DiscreteSampler(reference::texel_masses(map, claimed), claimed.density_space));
    const DensityComparison density = compare_density(sampler, expectation_of(map, declared), {});
    EXPECT_FALSE(check_declared_density(density).passed);
    EXPECT_FALSE(density.ratio.is_constant());
    EXPECT_TRUE(density.over_other_measure.is_constant());
    EXPECT_NEAR(density.over_other_measure.largest, 1.0, 1e-12);
  }
}

TEST(DensityCheck, NamesATexelThatIsNeverDrawnAndTheLightInIt) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const Expectation expectation = expectation_of(map, kTarget);
  const DensityComparison density = compare_density(with_mass(map, 17, 20, 0.0), expectation, {});
  const CheckResult support = check_support(density);
  EXPECT_FALSE(support.passed);
  EXPECT_NEAR(support.worst, expectation.masses(17, 20), 1e-6);
  EXPECT_THAT(support.detail, HasSubstr("texel (17, 20)"));
}

TEST(DensityCheck, LightThatADeclaredRoundingMayLoseIsReportedAndNotRejected) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const Expectation expectation = expectation_of(map, kTarget);
  const MassRounding rounding = {.relative = 1.01};
  const auto density = compare_density(with_mass(map, 17, 20, 0.0), expectation, rounding);
  const CheckResult support = check_support(density);
  EXPECT_TRUE(support.passed);
  EXPECT_NEAR(support.worst, expectation.masses(17, 20), 1e-6);
}

TEST(DensityCheck, FindsOneTexelThatIsOffByOnePercent) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const auto density =
      compare_density(with_mass(map, 17, 20, 1.01), expectation_of(map, kTarget), {});
  const CheckResult check = check_declared_density(density);
  EXPECT_FALSE(check.passed);
  EXPECT_NEAR(check.worst, 0.01, 1e-6);
  EXPECT_THAT(check.detail, HasSubstr("texel (17, 20)"));
  EXPECT_TRUE(check_support(density).passed);
}

TEST(DensityCheck, FindsAPdfWhereThereIsNoLight) {
  EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  map.radiance(5, 6) = Rgb(0.0F);
  const Expectation expectation = expectation_of(map, kTarget);
  map.radiance(5, 6) = Rgb(1e-6F);
  const auto sampler =
      bound(DiscreteSampler(reference::texel_masses(map, kTarget), kTarget.density_space));
  const CheckResult check = check_support(compare_density(sampler, expectation, {}));
  EXPECT_FALSE(check.passed);
  EXPECT_THAT(check.detail, HasSubstr("texel (5, 6)"));
}

TEST(DensityCheck, WhatIsNotANumberIsNoDensity) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  BoundSampler sampler =
      bound(DiscreteSampler(reference::texel_masses(map, kTarget), kTarget.density_space));
  sampler.pdf = [](SquarePoint) { return PerSquare{std::nan("")}; };
  EXPECT_FALSE(
      check_declared_density(compare_density(sampler, expectation_of(map, kTarget), {})).passed);
}

}  // namespace
}  // namespace lightproof
