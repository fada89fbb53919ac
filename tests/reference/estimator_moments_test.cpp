#include "reference/estimator_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "maps.h"

namespace lightproof::reference {
namespace {

Kernel constant_kernel() {
  return {[](Direction) { return KernelValue{1.0, 0.0}; }, [](Direction, double) { return false; }};
}

LightMoments moments(const Kernel& kernel, const EnvironmentMap& map) {
  const Grid<double> grids[] = {luminance_of(map)};
  return light_moments(kernel, grids).front();
}

LightMoments constant_map(const Kernel& kernel, Extent extent) {
  return moments(kernel, make_synthetic_map("constant", extent));
}

double relative_variance(const EstimatorMoments& m) { return m.variance() / (m.mean() * m.mean()); }

/// Where the horizon runs inside cells, the rule errs on a kink of slope 1: by 0.02 h^2 per unit
/// of its length 2 pi at worst, if it always lies in the middle of a cell; h = pi/1024 or less.
constexpr double kKink = 2.0 * kPi * 0.02 * (kPi / 1024.0) * (kPi / 1024.0);
// Mean pi and second moment follow with it; relative to the mean's square, times three.
constexpr double kTolerance = 3.0 * kKink;
/// No horizon, or along edges of cells: fourth order, 1e-9 for a cosine and 16 times that for
/// its square.
constexpr double kSmooth = 1.6e-8;

TEST(EstimatorMoments, CentralOnesFollowFromRawOnes) {
  // Two equal masses at 1 and 3: mean 2, variance 1, fourth central moment 1.
  const EstimatorMoments m{{2.0, 5.0, 14.0, 41.0}};
  EXPECT_EQ(m.mean(), 2.0);
  EXPECT_EQ(m.variance(), 1.0);
  EXPECT_EQ(m.fourth_central(), 1.0);
  // Masses 3/4 at 0 and 1/4 at 4: variance 3, fourth central moment 3/4 + 81/4.
  const EstimatorMoments skewed{{1.0, 4.0, 16.0, 64.0}};
  EXPECT_EQ(skewed.variance(), 3.0);
  EXPECT_EQ(skewed.fourth_central(), 21.0);
}

TEST(EstimatorMoments, AreNeverNegative) {
  const EstimatorMoments constant{{1.0, 1.0 - 1e-16, 1.0, 1.0 - 1e-15}};
  EXPECT_EQ(constant.variance(), 0.0);
  EXPECT_EQ(constant.fourth_central(), 0.0);
}

class EveryExtent : public testing::TestWithParam<Extent> {};

TEST_P(EveryExtent, IntegralOfAConstantMapIsTheSphere) {
  const LightMoments m = constant_map(constant_kernel(), GetParam());
  for (const EstimatorMoments* each :
       {&m[SampledDensity::uniform], &m[SampledDensity::texture_space],
        &m[SampledDensity::solid_angle]}) {
    EXPECT_NEAR(each->mean() / kSphere, 1.0, kSmooth);
  }
  EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), kPi * kPi / 8.0 - 1.0, kSmooth);
  EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), 0.2337, 5e-5) << "as printed";
  EXPECT_NEAR(relative_variance(m[SampledDensity::solid_angle]), 0.0, kSmooth);
  EXPECT_NEAR(relative_variance(m[SampledDensity::uniform]), 0.0, kSmooth);
}

TEST_P(EveryExtent, IrradianceOfAConstantMapAtThePoles) {
  for (const double z : {-1.0, 1.0}) {
    const LightMoments m = constant_map(cosine_kernel({0, 0, z}), GetParam());
    EXPECT_NEAR(m[SampledDensity::uniform].mean(), kPi, kTolerance);
    EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), kPi * kPi / 4.0 - 1.0,
                kTolerance);
    EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), 1.4674, 5e-5) << "as printed";
    EXPECT_NEAR(relative_variance(m[SampledDensity::solid_angle]), 5.0 / 3.0, kTolerance);
    EXPECT_NEAR(relative_variance(m[SampledDensity::uniform]), 5.0 / 3.0, kTolerance);
  }
}

TEST_P(EveryExtent, IrradianceOfAConstantMapAtTheHorizon) {
  for (const double azimuth : {0.0, 0.5 * kPi, 1.0, 4.0}) {
    const Direction normal = {std::cos(azimuth), std::sin(azimuth), 0.0};
    const LightMoments m = constant_map(cosine_kernel(normal), GetParam());
    EXPECT_NEAR(m[SampledDensity::uniform].mean(), kPi, kTolerance);
    EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), 3.0 * kPi * kPi / 8.0 - 1.0,
                kTolerance);
    EXPECT_NEAR(relative_variance(m[SampledDensity::texture_space]), 2.701, 5e-4) << "as printed";
    EXPECT_NEAR(relative_variance(m[SampledDensity::solid_angle]), 5.0 / 3.0, kTolerance);
  }
}

TEST_P(EveryExtent, IrradianceOfAConstantMapIsPiForAnyNormal) {
  for (const Direction along : {Direction(1, 2, 3), Direction(-3, 1, -0.5), Direction(0.1, 0, 1)}) {
    const LightMoments m = constant_map(cosine_kernel(glm::normalize(along)), GetParam());
    for (const EstimatorMoments* each :
         {&m[SampledDensity::uniform], &m[SampledDensity::texture_space],
          &m[SampledDensity::solid_angle]}) {
      EXPECT_NEAR(each->mean(), kPi, kTolerance);
    }
    EXPECT_NEAR(relative_variance(m[SampledDensity::solid_angle]), 5.0 / 3.0, kTolerance);
    // E[X^3] = (4 pi)^2 2 pi/4 and E[X^4] = (4 pi)^3 2 pi/5: no kink is left in them.
    EXPECT_NEAR(m[SampledDensity::uniform].raw[2] / (kSphere * kSphere * kPi / 2.0), 1.0,
                kTolerance);
    EXPECT_NEAR(m[SampledDensity::uniform].raw[3] / (std::pow(kSphere, 3) * 2.0 * kPi / 5.0), 1.0,
                kTolerance);
  }
}

TEST_P(EveryExtent, DiffuseStrategyHasNoVarianceOnAConstantMap) {
  constexpr double kAlbedo = 0.8;
  const Direction normal = glm::normalize(Direction(1, -2, 0.5));
  Kernel lambert = cosine_kernel(normal);
  lambert.at = [=](Direction d) {
    const double pdf = std::max(0.0, glm::dot(normal, d)) / kPi;
    return KernelValue{kAlbedo * pdf, pdf};
  };
  const LightMoments m = constant_map(lambert, GetParam());
  EXPECT_NEAR(m[SampledDensity::material].mean(), kAlbedo, kTolerance);
  // E[X^m] = albedo^m, times the same integral of the pdf, which is 1 up to the kink.
  EXPECT_NEAR(m[SampledDensity::material].variance(), 0.0, kTolerance);
  EXPECT_NEAR(m[SampledDensity::material].raw[3], std::pow(kAlbedo, 4), kTolerance);
  EXPECT_NEAR(m[SampledDensity::uniform].mean(), kAlbedo, kTolerance);
}

constexpr Extent kShapes[] = {{1, 1}, {2, 1}, {3, 5}, {33, 17}, {64, 32}};
std::string extent_name(const testing::TestParamInfo<Extent>& param) {
  return std::to_string(param.param.width) + "x" + std::to_string(param.param.height);
}
INSTANTIATE_TEST_SUITE_P(LightMoments, EveryExtent, testing::ValuesIn(kShapes), extent_name);

/// 4 pi^4 A sum L W2, W2 = (theta/2 - sin(2 theta)/4)/(pi S) from edge to edge: E[X^2] of scheme A
/// for k = 1.
double second_moment_of_a(const Grid<double>& luminance) {
  const Extent extent = luminance.extent();
  const auto primitive = [](double theta) { return 0.5 * theta - 0.25 * std::sin(2.0 * theta); };
  double mean = 0.0;
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    const double low = kPi * (1.0 - (y + 1.0) / extent.height);
    const double high = kPi * (1.0 - static_cast<double>(y) / extent.height);
    const double w2 = (primitive(high) - primitive(low)) / (kPi * extent.width);
    for (const double value : luminance.row(y)) {
      mean += value / static_cast<double>(extent.count());
      sum += value * w2;
    }
  }
  return 4.0 * std::pow(kPi, 4) * mean * sum;
}

/// 4 pi^4 mean(L w) Σ L W2 / w, w being the solid angle of a texel of the row.
double second_moment_of_c(const Grid<double>& luminance) {
  const Extent extent = luminance.extent();
  const auto primitive = [](double theta) { return 0.5 * theta - 0.25 * std::sin(2.0 * theta); };
  double mean = 0.0;
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    const double low = kPi * (1.0 - (y + 1.0) / extent.height);
    const double high = kPi * (1.0 - static_cast<double>(y) / extent.height);
    const double w = 2.0 * kPi / extent.width * (std::cos(low) - std::cos(high));
    const double w2 = (primitive(high) - primitive(low)) / (kPi * extent.width);
    for (const double value : luminance.row(y)) {
      mean += value * w / static_cast<double>(extent.count());
      sum += value / w * w2;
    }
  }
  return 4.0 * std::pow(kPi, 4) * mean * sum;
}

// What positions uniform in (s,t) cost where positions uniform in solid angle cost nothing: less
// than a digit of what is printed.
TEST(LightMoments, OfTheConstantMapUnderCAreThoseThatArePrinted) {
  struct Printed {
    int height;
    double variance;
    double digit;
  };
  for (const auto [height, variance, digit] :
       {Printed{4, 9.65e-2, 1e-4}, Printed{16, 1.05e-2, 1e-4}, Printed{64, 9.4e-4, 1e-5},
        Printed{256, 7.6e-5, 1e-6}}) {
    const LightMoments m = constant_map(constant_kernel(), {2 * height, height});
    EXPECT_NEAR(m[SampledDensity::sine_weighted].mean() / kSphere, 1.0, kSmooth);
    EXPECT_NEAR(relative_variance(m[SampledDensity::sine_weighted]), variance, 0.5 * digit)
        << height << " rows";
  }
}

TEST(LightMoments, OfTheIntegralOfAnyMapAreClosedForms) {
  // Under B X is the integral G itself, whatever the map.
  for (const SyntheticMap& synthetic : synthetic_maps()) {
    for (const Extent extent : {Extent{7, 5}, Extent{33, 17}}) {
      SCOPED_TRACE(synthetic.name);
      const EnvironmentMap map = synthetic.make(extent);
      const Grid<double> luminance = luminance_of(map);
      double total = 0.0;
      for (int y = 0; y < extent.height; ++y) {
        for (const double value : luminance.row(y)) total += value * texel_solid_angle(extent, y);
      }
      const LightMoments m = moments(constant_kernel(), map);
      for (std::size_t i = 0; i < 4; ++i) {
        const double power = std::pow(total, static_cast<double>(i + 1));
        EXPECT_NEAR(m[SampledDensity::solid_angle].raw[i] / power, 1.0, kSmooth);
      }
      EXPECT_NEAR(m[SampledDensity::texture_space].mean() / total, 1.0, kSmooth);
      EXPECT_NEAR(m[SampledDensity::texture_space].raw[1] / second_moment_of_a(luminance), 1.0,
                  kSmooth);
      EXPECT_NEAR(m[SampledDensity::sine_weighted].mean() / total, 1.0, kSmooth);
      EXPECT_NEAR(m[SampledDensity::sine_weighted].raw[1] / second_moment_of_c(luminance), 1.0,
                  kSmooth);
    }
  }
}

TEST(LightMoments, OfUniformDirectionsToOneTexelAreThoseOfAHit) {
  // X is 4 pi with the probability of the texel's share of the sphere.
  const Extent extent = {7, 5};
  const LightMoments m = moments(constant_kernel(), make_synthetic_map("one-texel", extent));
  const double solid_angle = texel_solid_angle(extent, 3);
  for (std::size_t i = 0; i < 4; ++i) {
    const double exact = solid_angle * std::pow(kSphere, static_cast<double>(i));
    EXPECT_NEAR(m[SampledDensity::uniform].raw[i] / exact, 1.0, kSmooth);
  }
}

TEST(LightMoments, OfSeveralMapsAreThoseOfEach) {
  const Extent extent = {33, 17};
  const Kernel kernel = cosine_kernel(glm::normalize(Direction(1, 1, 2)));
  const EnvironmentMap first = make_synthetic_map("gradient", extent);
  const EnvironmentMap second = make_synthetic_map("sun-sky", extent);
  const Grid<double> grids[] = {luminance_of(first), luminance_of(second)};
  const auto together = light_moments(kernel, grids);
  ASSERT_EQ(together.size(), 2U);
  EXPECT_EQ(together[0][SampledDensity::texture_space].raw,
            moments(kernel, first)[SampledDensity::texture_space].raw);
  EXPECT_EQ(together[1][SampledDensity::solid_angle].raw,
            moments(kernel, second)[SampledDensity::solid_angle].raw);
  EXPECT_EQ(together[1][SampledDensity::uniform].raw,
            moments(kernel, second)[SampledDensity::uniform].raw);
}

TEST(LightMoments, ScaleWithTheExposure) {
  const Extent extent = {3, 5};
  const Kernel kernel = cosine_kernel({0, 0, 1});
  Grid<double> luminance = luminance_of(make_synthetic_map("gradient", extent));
  const Grid<double> unit[] = {luminance};
  for (double& value : luminance.values()) value *= 0x1p60;
  const Grid<double> bright[] = {luminance};
  const LightMoments a = light_moments(kernel, unit).front();
  const LightMoments b = light_moments(kernel, bright).front();
  for (std::size_t m = 0; m < 4; ++m) {
    const double scale = std::pow(0x1p60, static_cast<double>(m + 1));
    EXPECT_EQ(b[SampledDensity::texture_space].raw[m],
              a[SampledDensity::texture_space].raw[m] * scale);
    EXPECT_EQ(b[SampledDensity::solid_angle].raw[m], a[SampledDensity::solid_angle].raw[m] * scale);
    EXPECT_EQ(b[SampledDensity::sine_weighted].raw[m],
              a[SampledDensity::sine_weighted].raw[m] * scale);
    EXPECT_EQ(b[SampledDensity::uniform].raw[m], a[SampledDensity::uniform].raw[m] * scale);
  }
}

TEST(CosineKernel, StraddlesExactlyNextToTheHorizon) {
  const Kernel kernel = cosine_kernel({0, 0, 1});
  const auto at_elevation = [](double angle) {
    return Direction(std::cos(angle), 0, std::sin(angle));
  };
  EXPECT_EQ(kernel.at(at_elevation(-0.1)).k, 0.0);
  EXPECT_DOUBLE_EQ(kernel.at(at_elevation(0.1)).k, std::sin(0.1));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(kernel.straddles(at_elevation(side * 0.099), 0.1));
    EXPECT_FALSE(kernel.straddles(at_elevation(side * 0.101), 0.1));
    EXPECT_TRUE(kernel.straddles(at_elevation(side * 1.5), 3.0)) << "a cap beyond a hemisphere";
  }
}

}  // namespace
}  // namespace lightproof::reference
