#include "lightproof/prefilter/brdf_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

constexpr Masking kMaskings[] = {Masking::karis, Masking::separable, Masking::height_correlated};

double lambda(double alpha, double cosine) {
  const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent * tangent) - 1.0);
}

double masking_of(Masking masking, double alpha, double view, double light) {
  const double k = 0.5 * alpha;
  switch (masking) {
    case Masking::karis:
      return view / (view * (1.0 - k) + k) * light / (light * (1.0 - k) + k);
    case Masking::separable:
      return 1.0 / (1.0 + lambda(alpha, view)) / (1.0 + lambda(alpha, light));
    case Masking::height_correlated:
      break;
  }
  return 1.0 / (1.0 + lambda(alpha, view) + lambda(alpha, light));
}

/// The textbook's D G F/(4 n·v n·l) n·l, integrated over the directions of light, adaptively.
ScaleBias brute_force(double mu, double roughness, Masking masking) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 31>;
  const double alpha = roughness * roughness;
  const Direction view = {std::sqrt(1.0 - mu * mu), 0.0, mu};
  const auto integral = [&](bool fresnel) {
    return Kronrod::integrate(
        [&](double theta) {
          return Kronrod::integrate(
              [&](double phi) {
                const Direction light = {std::sin(theta) * std::cos(phi),
                                         std::sin(theta) * std::sin(phi), std::cos(theta)};
                if (!(light.z > 0.0)) return 0.0;
                const Direction half = glm::normalize(light + view);
                const double tilt = (alpha * alpha - 1.0) * half.z * half.z + 1.0;
                const double distribution = alpha * alpha / (kPi * tilt * tilt);
                const double miss = std::pow(1.0 - glm::dot(view, half), 5.0);
                return 2.0 * std::sin(theta) * distribution / (4.0 * mu) *
                       masking_of(masking, alpha, mu, light.z) * (fresnel ? miss : 1.0 - miss);
              },
              0.0, kPi, 6, 1e-7);
        },
        0.0, 0.5 * kPi, 6, 1e-7);
  };
  return {integral(false), integral(true)};
}

TEST(BrdfIntegral, IsThatOverDirectionsOfLight) {
  for (const Masking masking : kMaskings) {
    for (const double roughness : {0.4, 0.7, 1.0}) {
      for (const double mu : {0.08, 0.5, 0.95}) {
        const ScaleBias exact = brute_force(mu, roughness, masking);
        const ScaleBias result = integrate_brdf(mu, roughness, masking);
        // The adaptive rule stops at 1e-7 of each integral; the quadrature promises 2e-6.
        EXPECT_NEAR(result.scale, exact.scale, 3e-6) << roughness << " " << mu;
        EXPECT_NEAR(result.bias, exact.bias, 3e-6) << roughness << " " << mu;
      }
    }
  }
}

struct Row {
  Masking masking;
  double roughness;
  double scale[3];  // at a cosine of .1, .5 and 1
  double bias[2];
};

// Computed elsewhere, by quadrature, to the digits that are printed.
constexpr Row kRows[] = {
    {Masking::height_correlated, 0.25, {0.5052, 0.9557, 0.9957}, {0.3916, 0.0326}},
    {Masking::height_correlated, 0.50, {0.7520, 0.8349, 0.9158}, {0.1397, 0.0224}},
    {Masking::height_correlated, 0.75, {0.7958, 0.6547, 0.6268}, {0.0526, 0.0085}},
    {Masking::height_correlated, 1.00, {0.7364, 0.4477, 0.3068}, {0.0239, 0.0030}},
    {Masking::karis, 0.25, {0.3913, 0.9023, 0.9943}, {0.2911, 0.0305}},
    {Masking::karis, 0.50, {0.5902, 0.7285, 0.8950}, {0.0984, 0.0186}},
    {Masking::karis, 0.75, {0.6409, 0.5730, 0.6036}, {0.0353, 0.0070}},
    {Masking::karis, 1.00, {0.5444, 0.4067, 0.3068}, {0.0136, 0.0025}},
};
constexpr double kCosines[] = {0.1, 0.5, 1.0};

TEST(BrdfIntegral, HasThePrintedValues) {
  for (const Row& row : kRows) {
    for (std::size_t i = 0; i < 3; ++i) {
      const ScaleBias result = integrate_brdf(kCosines[i], row.roughness, row.masking);
      EXPECT_NEAR(result.scale, row.scale[i], 1e-4);
      EXPECT_NEAR(result.bias, i < 2 ? row.bias[i] : 0.0, 1e-4);
    }
  }
}

TEST(BrdfIntegral, AtNormalViewIsTheFurnaceOfSingleScattering) {
  const auto whole = [](double roughness) {
    const ScaleBias result = integrate_brdf(1.0, roughness, Masking::height_correlated);
    return result.scale + result.bias;
  };
  EXPECT_NEAR(whole(1.0), 1.0 - std::log(2.0), 2e-6);
  EXPECT_NEAR(whole(0.25), 0.99569, 5e-6 + 2e-6) << "as printed";
  EXPECT_NEAR(whole(0.50), 0.91581, 5e-6 + 2e-6);
  EXPECT_NEAR(whole(0.75), 0.62689, 5e-6 + 2e-6);
}

TEST(BrdfIntegral, TendsToTheMirror) {
  for (const Masking masking : kMaskings) {
    for (const double mu : {0.0, 0.05, 0.3, 0.9, 1.0}) {
      const double miss = std::pow(1.0 - mu, 5.0);
      const ScaleBias mirror = integrate_brdf(mu, 0.0, masking);
      EXPECT_NEAR(mirror.scale, 1.0 - miss, 2e-6);
      EXPECT_NEAR(mirror.bias, miss, 2e-6);
      if (mu == 0.0) continue;
      // The second moment of the slopes is alpha^2 log(1/alpha^2), up to where they are cut off; it
      // meets second derivatives by slope of up to 20, those of Fresnel's factor, and 1/mu^2, those
      // of masking. Karis's k takes k/mu of either factor.
      const double alpha = 1e-4;
      const double tolerance = 2e-6 + alpha * alpha * std::log(1e8) * (20.0 + 1.0 / (mu * mu)) +
                               (masking == Masking::karis ? alpha / mu : 0.0);
      const ScaleBias smooth = integrate_brdf(mu, 0.01, masking);
      EXPECT_NEAR(smooth.scale, 1.0 - miss, tolerance) << mu;
      EXPECT_NEAR(smooth.bias, miss, tolerance) << mu;
    }
  }
}

TEST(BrdfIntegral, IsFiniteAndInTheUnitIntervalAtItsCorners) {
  for (const Masking masking : kMaskings) {
    for (const double roughness : {0.0, 1e-3, 0.01, 0.1, 1.0}) {
      for (const double mu : {0.0, 1e-12, 1e-6, 1e-3, 1.0}) {
        const ScaleBias result = integrate_brdf(mu, roughness, masking);
        EXPECT_GE(result.scale, 0.0);
        EXPECT_GE(result.bias, 0.0);
        // Smith's separable form reflects no more than the height-correlated one, which reflects
        // no more than comes in.
        EXPECT_LE(result.scale + result.bias, 1.0 + 2e-6) << mu << " " << roughness;
      }
    }
  }
}

TEST(BrdfMap, HoldsTheIntegralsAtItsTexelCentres) {
  const Extent extent = {67, 29};
  for (const Masking masking : kMaskings) {
    const Grid<ScaleBias> map = brdf_map(extent, masking);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        const ScaleBias exact = integrate_brdf((x + 0.5) / 67.0, (y + 0.5) / 29.0, masking);
        ASSERT_NEAR(map(x, y).scale, exact.scale, 5e-5 + 2e-6) << x << ", " << y;
        ASSERT_NEAR(map(x, y).bias, exact.bias, 5e-5 + 2e-6) << x << ", " << y;
      }
    }
  }
}

TEST(BrdfMap, HasTheSameBitsOnAnyNumberOfThreads) {
  const Grid<ScaleBias> many = brdf_map({40, 30}, Masking::separable);
  const ThreadLimit limit(1);
  const Grid<ScaleBias> one = brdf_map({40, 30}, Masking::separable);
  for (std::size_t i = 0; i < one.values().size(); ++i) {
    ASSERT_EQ(one.values()[i].scale, many.values()[i].scale);
    ASSERT_EQ(one.values()[i].bias, many.values()[i].bias);
  }
}

TEST(PublishedBrdfMap, ErrsAsMeasured) {
  // With Karis's masking and 1024 points; printed to two digits.
  struct Case {
    double mu;
    double roughness;
    double error;
  };
  for (const Case& each :
       {Case{0.1, 0.25, -1.3e-3}, Case{0.1, 0.5, 4.7e-3}, Case{0.5, 0.5, -1.4e-3}}) {
    const double exact = integrate_brdf(each.mu, each.roughness, Masking::karis).scale;
    for (const std::uint32_t first : {0U, 1U}) {
      const HammersleyRange points = {1024, first};
      const double sum = integrate_brdf(each.mu, each.roughness, Masking::karis, points).scale;
      // The two differ by one point of 1024, whose weight is some units.
      EXPECT_NEAR(sum - exact, each.error, 5e-5 + 2e-6 + first * 1e-3);
    }
  }
  EXPECT_EQ(HammersleyRange::published(1024).first, 1U);
}

TEST(PublishedBrdfMap, LosesItsFirstPointToOneBeyondTheSquare) {
  // n = 1 … N leaves out (0, 0) and takes (1, 1/2 + …) for it: other sums, of the same limit.
  const auto sum = [](std::uint32_t count, std::uint32_t first) {
    return integrate_brdf(0.5, 0.5, Masking::karis, HammersleyRange{count, first}).scale;
  };
  EXPECT_NE(sum(64, 0), sum(64, 1));
  const double exact = integrate_brdf(0.5, 0.5, Masking::karis).scale;
  EXPECT_LT(std::abs(sum(1 << 16, 1) - exact), std::abs(sum(64, 1) - exact));
  EXPECT_LT(std::abs(sum(1 << 16, 0) - exact), std::abs(sum(64, 0) - exact));
}

TEST(PublishedBrdfMap, IsNotANumberAtGrazingView) {
  EXPECT_TRUE(std::isnan(integrate_brdf(0.0, 0.5, Masking::karis, HammersleyRange{16, 1}).scale));
}

}  // namespace
}  // namespace lightproof
