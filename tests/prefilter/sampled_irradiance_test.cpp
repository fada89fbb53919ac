// Statistical tests are at 6 standard errors: 2e-9 each.
#include "lightproof/prefilter/sampled_irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/diffuse_comparisons.h"
#include "lightproof/prefilter/diffuse_shading.h"
#include "tests/prefilter/maps.h"

namespace lightproof {
namespace {

std::vector<SquarePoint> random_points(std::size_t count) {
  std::vector<SquarePoint> points(count);
  fill_points(RandomStream("prefilter/sampled irradiance", 1), 0, points);
  return points;
}

/// Estimates of one point each.
using Estimator = Irradiance (*)(const NearestRadiance&, Direction, std::span<const SquarePoint>);
Moments moments_of(Estimator estimate, const EnvironmentMap& map, Direction normal,
                   std::span<const SquarePoint> points) {
  const NearestRadiance radiance(map);
  Moments moments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    moments.add(estimate(radiance, normal, points.subspan(i, 1)).rgb.g);
  }
  return moments;
}
constexpr Estimator kCosine = cosine_sampled_irradiance<NearestRadiance>;
constexpr Estimator kUniform = uniform_sampled_irradiance<NearestRadiance>;

TEST(SampledIrradiance, HasTheMeanOfTheExactOne) {
  const EnvironmentMap map = random_map({32, 16});
  const std::vector<SquarePoint> points = random_points(1U << 16U);
  for (const Direction normal : {Direction(0, 0, -1), glm::normalize(Direction(-1, 2, 1))}) {
    const double exact = irradiance(map, normal).rgb.g;
    for (const Estimator estimator : {kCosine, kUniform}) {
      const Moments moments = moments_of(estimator, map, normal, points);
      EXPECT_NEAR(moments.mean(), exact, 6.0 * moments.standard_error());
      EXPECT_LT(moments.standard_error(), 0.01 * exact);
    }
  }
}

TEST(SampledIrradiance, ByCosineHasNoVarianceUnderConstantLight) {
  const EnvironmentMap map{"constant", Grid<Rgb>({4, 2}, Rgb(0.5F)), {}};
  const std::vector<SquarePoint> points = random_points(100);
  const Moments moments = moments_of(kCosine, map, glm::normalize(Direction(1, 2, 3)), points);
  EXPECT_EQ(moments.variance(), 0.0);
  EXPECT_EQ(moments.mean(), 0.5 * kPi);
  EXPECT_EQ(cosine_sampled_reflection(NearestRadiance(map), {0, 0, 1}, points).rgb,
            glm::dvec3(0.5));
}

TEST(SampledIrradiance, OfASmallLightVariesLessUniformlyBeyondSixtyDegrees) {
  // Of X² the means are pi L² c D by cosine and 2pi L² c² D uniformly; ratio 2 c. Of 2^19 samples
  // some 700 and more hit a light of 0.01 sr: the estimated ratio has a standard error below
  // sqrt(2/700) = 5 %, and c varies by 0.1 tan(angle) within.
  const Extent extent = {64, 32};
  const EnvironmentMap map = one_lit_texel(extent, 20, 16);
  const Direction light = direction_from_square({20.5 / 64, 16.5 / 32});
  const Frame frame = frame_around(light);
  const std::vector<SquarePoint> points = random_points(1U << 19U);
  for (const double degrees : {30.0, 72.0}) {
    const double angle = degrees * kPi / 180.0;
    const Direction normal = std::cos(angle) * light + std::sin(angle) * frame.tangent;
    const auto square = [&](Estimator estimator) {
      const Moments moments = moments_of(estimator, map, normal, points);
      return moments.variance() + moments.mean() * moments.mean();
    };
    EXPECT_NEAR(square(kUniform) / square(kCosine) / (2.0 * std::cos(angle)), 1.0, 0.3 + 0.02)
        << degrees;
    EXPECT_EQ(square(kUniform) < square(kCosine), degrees > 60.0) << degrees;
  }
}

TEST(SampledIrradiance, UniformlyAsPublishedIsTooSmallByFourPiSquared) {
  const EnvironmentMap map = random_map({8, 4});
  const std::vector<SquarePoint> points = random_points(64);
  const Direction normal = {0.6, 0.0, 0.8};
  const NearestRadiance radiance(map);
  const double corrected = uniform_sampled_irradiance(radiance, normal, points).rgb.r;
  const double published = uniform_sampled_irradiance_published(radiance, normal, points).rgb.r;
  EXPECT_NEAR(corrected / published, 4.0 * kPi * kPi, 1e-12);
}

TEST(SampledIrradianceMap, HasTheErrorThatItsVariancePredicts) {
  // The variance of pi L under cosine sampling is pi ∫ L² cos - E²: twice an exact irradiance. The
  // mean of z² over 512 normals is 1, with a standard deviation of sqrt(2/512) and, of sums of 256
  // samples that are bounded by some standard deviations, little more.
  const EnvironmentMap map = make_synthetic_map("gradient", {32, 16});
  EnvironmentMap squares = map;
  for (Rgb& texel : squares.radiance.values()) texel *= texel;
  const Extent normals = {32, 16};
  constexpr int kSamples = 256;
  const IrradianceMap sampled = cosine_sampled_irradiance_map(map, normals, kSamples, 1);
  const IrradianceMap exact = irradiance_map(map, normals);
  const IrradianceMap square = irradiance_map(squares, normals);
  Moments deviations;
  Moments squared_deviations;
  Moments products;  // of neighbours, which see much the same light but draw on their own
  double before = 0.0;
  for (std::size_t i = 0; i < normals.count(); ++i) {
    const double mean = exact.irradiance.values()[i].r;
    const double variance = (kPi * square.irradiance.values()[i].r - mean * mean) / kSamples;
    const double z = (sampled.irradiance.values()[i].r - mean) / std::sqrt(variance);
    deviations.add(z);
    squared_deviations.add(z * z);
    if (i > 0) products.add(z * before);
    before = z;
  }
  EXPECT_NEAR(deviations.mean(), 0.0, 6.0 / std::sqrt(512.0));
  EXPECT_NEAR(squared_deviations.mean(), 1.0, 6.0 * std::sqrt(2.1 / 512.0));
  EXPECT_NEAR(products.mean(), 0.0, 6.0 * products.standard_error());
}

TEST(SampledIrradianceMap, HasTheSameBitsForAnyNumberOfThreadsAndOthersForAnotherSeed) {
  const EnvironmentMap map = random_map({8, 4});
  const auto bits = [&](int threads, std::uint64_t seed) {
    const ThreadLimit limit(threads);
    return cosine_sampled_irradiance_map(map, {6, 4}, 10, seed);
  };
  const IrradianceMap one = bits(1, 1);
  EXPECT_TRUE(std::ranges::equal(one.irradiance.values(), bits(3, 1).irradiance.values()));
  EXPECT_FALSE(std::ranges::equal(one.irradiance.values(), bits(1, 2).irradiance.values()));
  EXPECT_THROW(cosine_sampled_irradiance_map(map, {6, 4}, 0, 1), InputError);
  EXPECT_THROW(cosine_sampled_irradiance_map(map, {6, 0}, 1, 1), InputError);
}

TEST(DiffuseReflection, IsTheColourTimesIrradianceOverPi) {
  const Irradiance light{glm::dvec3(kPi, 2.0 * kPi, 0.0)};
  const glm::dvec3 colour(0.5, 0.25, 1.0);
  EXPECT_EQ(diffuse_reflection(light, colour).rgb, glm::dvec3(0.5, 0.5, 0.0));
  EXPECT_EQ(diffuse_reflection(light, colour, 0.5).rgb, glm::dvec3(0.25, 0.25, 0.0));
  EXPECT_NEAR(diffuse_reflection_published(light, colour).rgb.g, 0.5 * kPi * kPi, 1e-15);
}

TEST(DiffuseReflection, AsPublishedLooksAwayFromTheLight) {
  const EnvironmentMap map = random_map({8, 4});
  const Direction normal = glm::normalize(Direction(1, 2, 3));
  EXPECT_EQ(opposite_hemisphere_published(map, normal).rgb, -irradiance(map, -normal).rgb);
  EXPECT_LT(opposite_hemisphere_published(map, normal).rgb.r, 0.0);
}

TEST(DiffuseReflection, UnderACoatIsWhatSchlickLetsThrough) {
  // The mean of 1 - F over cosine-distributed directions, u = sin², by the midpoint rule: off by a
  // few N^(-3/2) from where the cosine is 0.
  constexpr int kSteps = 1 << 16;
  for (const double f0 : {0.0, 0.04, 0.5, 1.0}) {
    double mean = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = std::sqrt(1.0 - (i + 0.5) / kSteps);
      mean += (1.0 - f0) * (1.0 - std::pow(1.0 - cosine, 5)) / kSteps;
    }
    EXPECT_NEAR(mean_transmittance(f0), mean, 1e-6) << f0;
    EXPECT_EQ(mean_transmittance_published(f0), 1.0);
  }
}

TEST(DiffuseComparisons, CorrectedIsExactAndPublishedIsOffByAsMuchAsKnown) {
  struct Known {
    std::string_view system;
    double exact;
    double published;
  };
  const Known known[] = {{"002-2", 1.0, 1.004124},   {"002-2", 1.0, 0.991762},
                         {"004-2", 1.0, kPi * kPi},  {"004-2", kPi, -kPi},
                         {"004-2", kPi, 0.25 / kPi}, {"004-3", 0.914286, 1.0}};
  const std::vector<PublishedComparison> rows = diffuse_comparisons();
  ASSERT_EQ(rows.size(), std::size(known));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].system, known[i].system);
    EXPECT_NEAR(rows[i].exact, known[i].exact, 5e-7) << rows[i].what;
    EXPECT_NEAR(rows[i].published, known[i].published, 5e-7) << rows[i].what;
    EXPECT_NEAR(rows[i].corrected, rows[i].exact, 1e-13) << rows[i].what;
  }
}

}  // namespace
}  // namespace lightproof
