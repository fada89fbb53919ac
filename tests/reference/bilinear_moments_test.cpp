#include "reference/bilinear_moments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/image/look_up.h"
#include "lightproof/image/synthetic.h"
#include "maps.h"

namespace lightproof::reference {
namespace {

Kernel one() {
  return {[](Direction) {
            return KernelValue{1.0, 1.0 / kSphere};
          },
          [](Direction, double) { return false; }};
}

// The quadrature's own error is below 1e-9 of integrands as smooth as a cosine.
constexpr double kQuadrature = 1e-9;

TEST(BilinearMoments, OfAConstantMapAreThoseOfWholeTexels) {
  for (const Extent extent : {Extent{1, 1}, Extent{5, 3}, Extent{64, 32}}) {
    const Grid<double> luminance(extent, 2.0);
    for (const Direction normal : {Direction{0.0, 0.0, 1.0}, Direction{1.0, 0.0, 0.0}}) {
      const Kernel kernel = cosine_kernel(normal);
      const LightMoments tents = bilinear_light_moments(kernel, luminance);
      const LightMoments whole = light_moments(kernel, {&luminance, 1})[0];
      const auto expect_same = [](const EstimatorMoments& a, const EstimatorMoments& b) {
        // Cells on the horizon are split elsewhere: kEdge of a texel's share each.
        constexpr double kEdge = 1e-5;
        for (std::size_t m = 0; m < a.raw.size(); ++m) {
          EXPECT_NEAR(a.raw[m], b.raw[m], kEdge * b.raw[m]);
        }
        EXPECT_NEAR(a.largest, b.largest, 1e-3 * b.largest);
      };
      expect_same(tents[SampledDensity::uniform], whole[SampledDensity::uniform]);
      expect_same(tents[SampledDensity::texture_space], whole[SampledDensity::texture_space]);
      expect_same(tents[SampledDensity::solid_angle], whole[SampledDensity::solid_angle]);
    }
  }
}

// Two columns of 1 and 3: L is linear in s from 1 to 3 and back, and constant in t. The means of
// L^m are 2, 13/3, 10, 121/5; G = 8 pi; those of sin^m over t are 1, 2/pi, 1/2, 4/(3 pi), 3/8.
TEST(BilinearMoments, TwoColumns) {
  const Grid<double> luminance = luminance_of(grey_map({2, 1}, {1.0F, 3.0F}));
  const LightMoments moments = bilinear_light_moments(one(), luminance);
  const double powers[] = {2.0, 13.0 / 3.0, 10.0, 121.0 / 5.0};
  const double sines[] = {2.0 / kPi, 0.5, 4.0 / (3.0 * kPi), 0.375};
  for (int m = 1; m <= 4; ++m) {
    const auto i = static_cast<std::size_t>(m - 1);
    const double uniform = std::pow(kSphere, m) * powers[i];
    EXPECT_NEAR(moments[SampledDensity::uniform].raw[i], uniform, kQuadrature * uniform);
    EXPECT_NEAR(moments[SampledDensity::material].raw[i], uniform, kQuadrature * uniform);
    // X = 2 pi^2 A sin(theta), and p(s,t) = L / A.
    const double a = std::pow(4.0 * kPi * kPi, m) * sines[i];
    EXPECT_NEAR(moments[SampledDensity::texture_space].raw[i], a, kQuadrature * a);
    EXPECT_NEAR(moments[SampledDensity::sine_weighted].raw[i], a, kQuadrature * a) << "of one row";
    const double b = std::pow(8.0 * kPi, m);
    EXPECT_NEAR(moments[SampledDensity::solid_angle].raw[i], b, kQuadrature * b);
  }
  EXPECT_NEAR(moments[SampledDensity::uniform].largest, 3.0 * kSphere, kQuadrature * 3.0 * kSphere);
}

// p(s,t) = L / A: E[1/p(omega)^2 in the bright part] = ∫ 4 pi^4 sin^2 A / L = 2 pi^4 A mean(1/L),
// and 1/L is ln(c)/(c-1) on average from 1 to c. The rule's error is below 1e-7.
TEST(BilinearInversePdf, TwoColumnsOfAnyContrast) {
  for (const double c : {3.0, 1e5}) {
    const Grid<double> luminance = luminance_of(grey_map({2, 1}, {1.0F, static_cast<float>(c)}));
    const auto all = [](double) { return true; };
    const double mean = 0.5 * (1.0 + c);
    const double reciprocal = std::log(c) / (c - 1.0);
    const EstimatorMoments a = bilinear_inverse_pdf(luminance, DensitySpace::texture, all);
    EXPECT_NEAR(a.raw[0], kSphere, 1e-12);
    const double square = 2.0 * std::pow(kPi, 4) * mean * reciprocal;
    EXPECT_NEAR(a.raw[1], square, 1e-7 * square);
    EXPECT_NEAR(a.largest, 2.0 * kPi * kPi * mean, 1e-6 * a.largest);
    const EstimatorMoments b = bilinear_inverse_pdf(luminance, DensitySpace::solid_angle, all);
    const double square_b = kSphere * kSphere * mean * reciprocal;
    EXPECT_NEAR(b.raw[1], square_b, 1e-7 * square_b);
  }
}

// Two rows, of which t is the steep direction: against the middle rule with 2^20 points, whose own
// error is below 1e-6 where L doubles in ten of them.
TEST(BilinearInversePdf, TwoRowsOfMuchContrast) {
  const Grid<double> luminance = luminance_of(grey_map({1, 2}, {1.0F, 1e3F}));
  const auto all = [](double) { return true; };
  constexpr int kPoints = 1 << 20;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double t = (i + 0.5) / kPoints;
    const double jacobian = solid_angle_per_square(t);
    sum += jacobian * jacobian / look_up(luminance, Lookup::bilinear, {0.5, t}) / kPoints;
  }
  const double square = sum * 0.5 * (1.0 + 1e3);
  EXPECT_NEAR(bilinear_inverse_pdf(luminance, DensitySpace::texture, all).raw[1], square,
              1e-6 * square);
}

TEST(BilinearInversePdf, OnlyBrightTexelsCount) {
  const Grid<double> luminance = luminance_of(grey_map({4, 1}, {1.0F, 4.0F, 1.0F, 0.0F}));
  const auto some = [](double radiance) { return radiance >= 0.5; };
  const EstimatorMoments moments = bilinear_inverse_pdf(luminance, DensitySpace::solid_angle, some);
  EXPECT_NEAR(moments.raw[0], 0.75 * kSphere, 1e-12);
  // From a centre of 1 to the edge of the dark texel L falls to 1/2: G / L is 2 G there.
  EXPECT_NEAR(moments.largest, 2.0 * kSphere * 1.5, 1e-6);
}

}  // namespace
}  // namespace lightproof::reference
