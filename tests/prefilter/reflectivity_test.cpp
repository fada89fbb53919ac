#include "lightproof/prefilter/reflectivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/specular_comparisons.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

/// Below the chance of 1e-9 for a normal deviate, on either side.
constexpr double kDeviations = 6.2;

Grid<Rgb> white() { return Grid<Rgb>({8, 4}, Rgb(1.0F)); }

TEST(Reflectivity, LevelsAreLookedUpAtTheirOwnRoughness) {
  for (int level = 0; level < kReflectivityLevels; ++level) {
    EXPECT_NEAR(level_of_reflectivity(reflectivity_roughness(level)), level, 1e-15 * 7);
  }
  EXPECT_DOUBLE_EQ(level_of_reflectivity(1.0), 6.5);
}

TEST(Reflectivity, PublishedRoughnessMakesTheShininessNegative) {
  EXPECT_GT(half_vector_shininess(reflectivity_roughness_published(0)), 0.0);
  for (int level = 1; level < kReflectivityLevels; ++level) {
    EXPECT_LT(half_vector_shininess(reflectivity_roughness_published(level)), 0.0);
    EXPECT_GT(half_vector_shininess(reflectivity_roughness(level)), 0.0);
  }
  EXPECT_TRUE(std::isinf(half_vector_shininess(0.0)));
  EXPECT_EQ(half_vector_shininess(1.0), 0.0);
}

TEST(Reflectivity, MapsAreTwiceAsWideAsHigh) {
  EXPECT_EQ(reflectivity_extent(1024), (Extent{1024, 512}));
  EXPECT_EQ(reflectivity_extent_published(1024), (Extent{1024, 2048}));
}

TEST(ReflectivityWeight, HasTheMeanOneAndItsVariance) {
  // Over r = cos^(S+1) uniform: moments of cos by adaptive quadrature.
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (const double shininess : {0.0, 1.5, 30.0, 1000.0}) {
    const auto moment = [&](double power) {
      return Kronrod::integrate(
          [&](double r) {
            const double cosine = std::pow(r, 1.0 / (shininess + 1.0));
            return std::pow(reflectivity_weight(shininess, cosine), power);
          },
          0.0, 1.0, 15, 1e-12);
    };
    EXPECT_NEAR(moment(1.0), 1.0, 1e-10);
    EXPECT_NEAR(moment(2.0) - 1.0, weight_variance(shininess), 1e-10);
    EXPECT_NEAR(reflectivity_weight_published(shininess, 0.7),
                2.0 / kPi * reflectivity_weight(shininess, 0.7), 1e-15);
  }
}

TEST(ReflectivityWeight, WouldNotVaryWithTheRightExponent) {
  // r^(1/(S+2)) draws in proportion to D cos: the weight D cos/pdf is the same for every draw.
  constexpr double kShininess = 12.0;
  for (const double r : {0.01, 0.4, 0.9}) {
    const double cosine = std::pow(r, 1.0 / (kShininess + 2.0));
    const double density = (kShininess + 2.0) / (2.0 * kPi) * std::pow(cosine, kShininess + 1.0);
    const double distribution = (kShininess + 2.0) / (2.0 * kPi) * std::pow(cosine, kShininess);
    EXPECT_NEAR(distribution * cosine / density, 1.0, 1e-14);
  }
}

TEST(ReflectivityDraws, SkipTheSharesThatFollow) {
  // Equal steps of the number find a share to 1/N.
  constexpr int kSteps = 200000;
  for (const double shininess : {0.5, 5.0, 30.0}) {
    int below = 0;
    int faint = 0;
    for (int i = 0; i < kSteps; ++i) {
      const HalfVectorDraw draw = draw_half_vector(shininess, {(i + 0.5) / kSteps, 0.25});
      if (!(draw.light.z > 0.0)) ++below;
      if (is_skipped_published(shininess, draw.half_cosine)) ++faint;
    }
    EXPECT_NEAR(static_cast<double>(below) / kSteps, half_vector_below_horizon(shininess),
                1.0 / kSteps);
    EXPECT_NEAR(static_cast<double>(faint) / kSteps, skipped_share(shininess), 1.0 / kSteps);
  }
}

/// The mean over all texels of a white map after one long frame.
double white_mean(double roughness, ReflectivityForm form, int samples) {
  const Grid<Rgb> map = white();
  ReflectivityAccumulation accumulation(map, {16, 8}, roughness, form,
                                        RandomStream("Reflectivity.white", 1));
  accumulation.add_frame(samples);
  double sum = 0.0;
  const Grid<Rgb> mean = accumulation.mean();
  for (const Rgb value : mean.values()) sum += static_cast<double>(value.r);
  return sum / 128.0;
}

TEST(Reflectivity, OfAWhiteMapIsTheExactValueOfItsForm) {
  constexpr int kSamples = 4000;
  for (const double roughness : {0.5, 0.75, 1.0}) {
    const double shininess = half_vector_shininess(roughness);
    EXPECT_NEAR(white_mean(roughness, ReflectivityForm::normalised, kSamples), 1.0, 1e-7);
    // A weight is at most (S+2)/(S+1), 2/pi of that as published: its deviation at most half.
    const double deviation =
        0.5 * (shininess + 2.0) / (shininess + 1.0) / std::sqrt(128.0 * kSamples);
    EXPECT_NEAR(white_mean(roughness, ReflectivityForm::per_draw, kSamples),
                1.0 - std::exp2(-0.5 * (shininess + 2.0)), kDeviations * deviation);
    // Only the good samples are counted: half of them at the least.
    EXPECT_NEAR(white_mean(roughness, ReflectivityForm::published, kSamples),
                white_map_comparison(roughness).published,
                kDeviations * std::sqrt(4.0) * deviation + skipped_share(shininess));
  }
  // As printed.
  EXPECT_NEAR(white_map_comparison(0.5).published, 0.6366, 5e-5);
  EXPECT_NEAR(white_map_comparison(0.75).published, 0.6717, 5e-5);
  EXPECT_NEAR(white_map_comparison(1.0).published, 1.0868, 5e-5);
}

TEST(Reflectivity, ByFramesIsTheSameAsAtOnce) {
  const Grid<Rgb> map = make_synthetic_map("checker", {16, 8}).radiance;
  for (const ReflectivityForm form : {ReflectivityForm::per_draw, ReflectivityForm::normalised}) {
    ReflectivityAccumulation frames(map, {4, 2}, 0.6, form, RandomStream("Reflectivity.frames", 1));
    ReflectivityAccumulation at_once(map, {4, 2}, 0.6, form,
                                     RandomStream("Reflectivity.frames", 1));
    for (int frame = 0; frame < 10; ++frame) frames.add_frame(16);
    at_once.add_frame(160);
    EXPECT_EQ(frames.samples(), at_once.samples());
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(frames.mean().values()[i], at_once.mean().values()[i]);
    }
  }
}

TEST(Reflectivity, TendsToTheExactMap) {
  const Grid<Rgb> map = make_synthetic_map("checker", {32, 16}).radiance;
  const Extent extent = {8, 4};
  for (const double roughness : {0.3, 0.8}) {
    const double shininess = half_vector_shininess(roughness);
    const Grid<glm::dvec3> exact =
        reference::prefiltered(map, reference::half_vector_lobe(shininess), extent);
    ReflectivityAccumulation accumulation(map, extent, roughness, ReflectivityForm::normalised,
                                          RandomStream("Reflectivity.exact", 1));
    constexpr int kSamples = 20000;
    accumulation.add_frame(kSamples);
    const Grid<Rgb> mean = accumulation.mean();
    for (std::size_t i = 0; i < exact.values().size(); ++i) {
      // Values between .1 and 1, weights of up to 2 of which at least half count: the ratio's
      // deviation is at most 2 over the root of the number. 96 values, none of them beyond.
      EXPECT_NEAR(mean.values()[i].r, exact.values()[i].r, kDeviations * 2.0 / std::sqrt(kSamples));
    }
  }
}

TEST(ReflectivityChain, IsTheExactMapOfEveryLevel) {
  const Grid<Rgb> map = make_synthetic_map("checker", {32, 16}).radiance;
  const SpecularChain chain = reflectivity_chain(map, {32, 16}, 5);
  ASSERT_EQ(chain.size(), 5U);
  for (int level = 0; level < 5; ++level) {
    const double shininess = half_vector_shininess(reflectivity_roughness(level, 5));
    const Extent extent = {32 >> level, 16 >> level};
    const Grid<glm::dvec3> exact =
        reference::prefiltered(map, reference::half_vector_lobe(shininess), extent);
    for (std::size_t i = 0; i < exact.values().size(); ++i) {
      // The reference's horizon is cut to 1e-3 radians: of a circle of some 6 radians, where values
      // differ by up to 1, in 2 pi steradian, so much is in doubt at the most.
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(chain[static_cast<std::size_t>(level)].values()[i][c], exact.values()[i][c],
                    1e-3);
      }
    }
  }
}

TEST(PublishedReflectivity, DrawsOnUntilASampleIsGood) {
  // At roughness 1 half-vectors are uniform in their cosine: .707 of them mirror from below. With
  // one sample a frame, most frames need more; none is ever black.
  const Grid<Rgb> map = white();
  ReflectivityAccumulation accumulation(map, {16, 8}, 1.0, ReflectivityForm::published,
                                        RandomStream("Reflectivity.good", 1));
  accumulation.add_frame(1);
  const Grid<Rgb> first = accumulation.mean();
  for (const Rgb value : first.values()) EXPECT_GT(value.r, 0.0F);
  EXPECT_EQ(accumulation.samples(), 1U) << "and it counts one";
  // The next frame draws the second number again: where both frames had to go on to the same one,
  // they show the same sample, and the mean of the two is the first.
  accumulation.add_frame(1);
  const Grid<Rgb> second = accumulation.mean();
  int repeated = 0;
  for (std::size_t i = 0; i < 128; ++i) repeated += first.values()[i] == second.values()[i] ? 1 : 0;
  // The first number is bad in .707 of the texels.
  EXPECT_GT(repeated, 50);
  EXPECT_NEAR(repeated_draws_comparison(1.0, 1).published, std::sqrt(0.5) / (1.0 - std::sqrt(0.5)),
              1e-12);
}

TEST(Reflectivity, HasTheSameBitsOnAnyNumberOfThreads) {
  const Grid<Rgb> map = make_synthetic_map("checker", {16, 8}).radiance;
  for (const ReflectivityForm form : {ReflectivityForm::published, ReflectivityForm::normalised}) {
    const auto made = [&] {
      ReflectivityAccumulation accumulation(map, {16, 8}, 0.9, form,
                                            RandomStream("Reflectivity.threads", 1));
      accumulation.add_frame(20);
      accumulation.add_frame(20);
      return accumulation.mean();
    };
    const Grid<Rgb> many = made();
    const ThreadLimit limit(1);
    const Grid<Rgb> one = made();
    for (std::size_t i = 0; i < 128; ++i) ASSERT_EQ(one.values()[i], many.values()[i]);
  }
}

TEST(Reflectivity, RefusesARoughnessWithoutALobe) {
  const Grid<Rgb> map = white();
  for (const double roughness : {0.0, -1.0, 1.5, std::nan("")}) {
    EXPECT_THAT(
        [&] {
          ReflectivityAccumulation(map, {4, 2}, roughness, ReflectivityForm::per_draw,
                                   RandomStream("Reflectivity.refused", 1));
        },
        testing::ThrowsMessage<InputError>(testing::HasSubstr("a roughness of")));
  }
}

}  // namespace
}  // namespace lightproof
