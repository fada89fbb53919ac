// Exact moments of estimators that combine the densities of material and map, against closed forms
// and printed figures.
#include "reference/combined_moments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

/// A cosine that is drawn with a density over directions of its own.
Kernel drawn_cosine(Direction normal, double (*pdf)(double cosine)) {
  Kernel kernel = cosine_kernel(normal);
  kernel.at = [normal, pdf](Direction d) {
    const double cosine = std::max(0.0, glm::dot(normal, d));
    return KernelValue{cosine, pdf(cosine)};
  };
  return kernel;
}
double uniform_pdf(double /*cosine*/) { return 1.0 / kSphere; }
double cosine_pdf(double cosine) { return cosine / kPi; }

/// A grid of a function of the height z, by its value at the rows' centres.
template <class Value>
Grid<double> zonal(Extent extent, const Value& value) {
  Grid<double> grid(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (double& cell : grid.row(y)) cell = value(cos_theta((y + 0.5) / extent.height));
  }
  return grid;
}

double relative(const MeanAndVariance& m) { return m.variance / (m.mean * m.mean); }

/// As in the tests of estimator_moments.h: a kink at the horizon, relative, times three.
constexpr double kTolerance = 6.0 * kPi * 0.02 * (kPi / 1024.0) * (kPi / 1024.0);

const Direction kOblique = {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};

// Two techniques of one density are one technique, whatever the heuristic: variance 5/3 for a
// cosine under uniform directions, mean pi. A constant map has nothing left above its mean, and is
// drawn from as it is.
TEST(CombinedMoments, OfEqualDensitiesAreThoseOfOne) {
  const Grid<double> constant({32, 16}, 1.0);
  const Kernel kernel = drawn_cosine(kOblique, uniform_pdf);
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    for (const double compensation : {0.0, 0.5, 1.0}) {
      for (const bool one_sample : {false, true}) {
        const MeanAndVariance m =
            combined_moments(kernel, {&constant, 1}, {one_sample, heuristic, compensation})[0];
        EXPECT_NEAR(m.mean / kPi, 1.0, kTolerance);
        EXPECT_NEAR(relative(m), 5.0 / 3.0, kTolerance);
        EXPECT_NEAR(m.largest, kSphere, 1e-3 * kSphere) << "at the normal, between two nodes";
      }
    }
  }
}

// A constant map, lobes with the density cos/pi: under the balance heuristic of one sample,
// p = (cos/pi + 1/4pi)/2, and E[X^2] = 2 pi ∫ c^2 / p dc = 4 pi^2 ∫ c^2 / (c + 1/4) dc over [0,1],
// whose integral is 1/2 - 1/4 + ln(5)/16.
TEST(CombinedMoments, OfOneSampleHaveAClosedForm) {
  const Grid<double> constant({32, 16}, 1.0);
  const MeanAndVariance m = combined_moments(drawn_cosine(kOblique, cosine_pdf), {&constant, 1},
                                             {.is_one_sample = true})[0];
  EXPECT_NEAR(relative(m), 4.0 * (0.25 + std::log(5.0) / 16.0) - 1.0, kTolerance);
}

// The multi-sample estimator of the same: w f / p = c / (c/pi + 1/4pi) = pi x with x = c / (c +
// 1/4) is what either technique estimates with half the light's weight each. The two means under
// the densities c/pi and 1/4pi are 2 pi^2 ∫ x c dc / pi and 2 pi^2 ∫ x dc / 4pi, squares likewise.
TEST(CombinedMoments, OfPairsAreSumsOverTechniques) {
  const GaussRule<3> rule;
  const auto integral = [&](const auto& f) {
    double sum = 0.0;
    for (int i = 0; i < 256; ++i) sum += rule.integrate(i / 256.0, (i + 1) / 256.0, f);
    return sum;
  };
  const auto x = [](double c) { return kPi * c / (c + 0.25); };
  const double lobes = integral([&](double c) { return 2.0 * c * x(c); });
  const double map = integral([&](double c) { return 0.5 * x(c); });
  const double lobe_squares = integral([&](double c) { return 2.0 * c * x(c) * x(c); });
  const double map_squares = integral([&](double c) { return 0.5 * x(c) * x(c); });
  const double variance = lobe_squares - lobes * lobes + map_squares - map * map;
  EXPECT_NEAR(lobes + map, kPi, 1e-9);
  const Grid<double> constant({32, 16}, 1.0);
  const MeanAndVariance m =
      combined_moments(drawn_cosine(kOblique, cosine_pdf), {&constant, 1}, CombinedSampling{})[0];
  EXPECT_NEAR(m.variance / (2.0 * variance), 1.0, kTolerance);
}

// Printed: the map 1 + 0.2 z and cosine lobes, averaged over all normals; N times the variance of
// an even number N of samples. Compensation helps pairs and harms one-sample estimates.
TEST(CombinedMoments, ShowThatCompensationIsForPairs) {
  const Grid<double> map = zonal({64, 256}, [](double z) { return 1.0 + 0.2 * z; });
  const CombinedSampling samplings[] = {{},
                                        {.compensation = 1.0},
                                        {.is_one_sample = true},
                                        {.is_one_sample = true, .compensation = 1.0}};
  constexpr int kNormals = 32;
  double means[4] = {};
  for (int n = 0; n < kNormals; ++n) {
    const double z = -1.0 + (2.0 * n + 1.0) / kNormals;
    const Kernel kernel = drawn_cosine({std::sqrt(1.0 - z * z), 0.0, z}, cosine_pdf);
    const auto moments = combined_moments(kernel, {&map, 1}, samplings);
    for (std::size_t i = 0; i < 4; ++i) means[i] += relative(moments[i][0]) / kNormals;
  }
  EXPECT_NEAR(means[0], 0.246, 1e-3);
  EXPECT_NEAR(means[1], 0.154, 1e-3);
  EXPECT_NEAR(means[2], 0.407, 1e-3);
  EXPECT_NEAR(means[3], 0.544, 1e-3);
}

TEST(DensityMoments, OfUniformDirectionsAreThoseOfOneDensity) {
  const Grid<double> map = luminance_of(make_synthetic_map("checker", {32, 16}));
  const Kernel kernel = cosine_kernel(kOblique);
  const EstimatorMoments expected = light_moments(kernel, {&map, 1})[0][SampledDensity::uniform];
  const MeanAndVariance m =
      density_moments(kernel, {&map, 1}, [](const Node&) { return 1.0 / kSphere; })[0];
  EXPECT_NEAR(m.mean / expected.mean(), 1.0, 1e-12);
  EXPECT_NEAR(m.variance / expected.variance(), 1.0, 1e-11);
  EXPECT_NEAR(m.largest / expected.largest, 1.0, 1e-12);
  EXPECT_NEAR(m.fourth_central / expected.fourth_central(), 1.0, 1e-10);
}

// A constant map and lobes that are the whole sphere: both techniques are the uniform one, a sample
// of either is a uniform one, and a pair is the mean of two. Of a mean of n the fourth central
// moment is (m4 + 3 (n - 1) v^2) / n^3.
TEST(CombinedMoments, OfTwoEqualTechniquesHaveTheFourthMomentsOfOne) {
  const Grid<double> map = zonal({64, 32}, [](double) { return 1.0; });
  Kernel kernel = cosine_kernel(kOblique);
  kernel.at = [at = kernel.at](Direction d) { return KernelValue{at(d).k, 1.0 / kSphere}; };
  const EstimatorMoments uniform = light_moments(kernel, {&map, 1})[0][SampledDensity::uniform];
  const double v = uniform.variance();
  const CombinedSampling samplings[] = {{}, {.is_one_sample = true}};
  const auto moments = combined_moments(kernel, {&map, 1}, samplings);
  EXPECT_NEAR(moments[0][0].fourth_central, (uniform.fourth_central() + 3.0 * v * v) / 8.0,
              1e-9 * v * v);
  EXPECT_NEAR(moments[1][0].fourth_central, uniform.fourth_central(), 1e-9 * v * v);
}

// Cells are h = pi/512 wide, and cos^n has the second derivative -n at its peak: there the middle
// of a cell is n h^2/24 too high. Of n = 6000, that of the variance, this is 1 %.
TEST(CombinedMoments, OfTheMiddlesOfTexelsAreThoseOfAllNodes) {
  const Grid<double> map = luminance_of(make_synthetic_map("sun-sky", {1024, 512}));
  Kernel kernel = cosine_kernel(kOblique);
  kernel.at = [](Direction d) {
    const double k = std::pow(std::max(0.0, glm::dot(d, kOblique)), 3000.0);
    return KernelValue{k, 3001.0 / (2.0 * kPi) * k};
  };
  const CombinedSampling samplings[] = {{}, {.is_one_sample = true, .compensation = 0.5}};
  const auto gauss = combined_moments(kernel, {&map, 1}, samplings);
  const auto middles = combined_moments(kernel, {&map, 1}, samplings, CellRule::midpoint);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(middles[i][0].mean / gauss[i][0].mean, 1.0, 0.005);
    EXPECT_NEAR(middles[i][0].variance / gauss[i][0].variance, 1.0, 0.01);
  }
}

}  // namespace
}  // namespace lightproof::reference
