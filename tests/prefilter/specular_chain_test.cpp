#include "lightproof/prefilter/specular_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/chain_interpolation.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

auto says(std::string_view words) {
  return testing::ThrowsMessage<InputError>(testing::HasSubstr(std::string(words)));
}

TEST(SpecularChain, HalvesItsLevelsDownToOneTexel) {
  const std::vector<Extent> extents = level_extents({512, 256}, 10);
  EXPECT_EQ(extents[0], (Extent{512, 256}));
  EXPECT_EQ(extents[1], (Extent{256, 128}));
  EXPECT_EQ(extents[8], (Extent{2, 1}));
  EXPECT_EQ(extents[9], (Extent{1, 1}));
  EXPECT_EQ(level_extents({2000, 1000}, 11).back(), (Extent{1, 1}));
}

TEST(SpecularChain, RefusesLevelsThatASizeCannotHave) {
  EXPECT_THAT(
      [] {
        level_extents({512, 256}, 11);
      },
      says("11 levels of 512 x 256 texels: 1 to 10"));
  EXPECT_THAT([] { level_extents({512, 256}, 0); }, says("0 levels"));
  EXPECT_THAT([] { level_extents({0, 256}, 1); }, says("0 x 256"));
}

TEST(SpecularChain, RefusesARoughnessBeyondTheUnitInterval) {
  EXPECT_THAT([] { ggx_lobe(-0.1); }, says("a roughness of -0.1: 0 (a mirror) to 1 needed"));
  EXPECT_THAT([] { ggx_lobe(1.5); }, says("1.5"));
  EXPECT_THAT([] { ggx_lobe(std::nan("")); }, says("nan"));
  EXPECT_FALSE(ggx_lobe(0.0).has_value()) << "the mirror";
  EXPECT_TRUE(ggx_lobe(1.0).has_value());
}

TEST(SpecularChain, RefusesPhongExponentsThatAreNone) {
  const Grid<Rgb> map({4, 2}, Rgb(1.0F));
  for (const double exponent : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([&] { phong_chain(map, {4, 2}, {&exponent, 1}); }, says("a Phong exponent of"));
  }
}

TEST(SpecularChain, SpacesItsRoughnessEvenlyFromTheMirror) {
  EXPECT_EQ(level_roughness(1), (std::vector<double>{0.0}));
  EXPECT_EQ(level_roughness(5), (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
}

TEST(SpecularChain, LevelsAreTheMapBlurredByTheirRoughness) {
  const Grid<Rgb> map = make_synthetic_map("checker", {32, 16}).radiance;
  const SpecularChain chain = ggx_chain(map, {32, 16}, 5);
  ASSERT_EQ(chain.size(), 5U);
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    ASSERT_EQ(chain[0].values()[i], map.values()[i]);
  }
  for (std::size_t level = 1; level < 5; ++level) {
    const double roughness = 0.25 * static_cast<double>(level);
    const Extent extent = {32 >> level, 16 >> level};
    ASSERT_EQ(chain[level].extent(), extent);
    const Grid<glm::dvec3> exact =
        reference::prefiltered(map, reference::ggx_lobe(roughness * roughness), extent);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        // The reference's 1e-5 of values up to 1.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(chain[level](x, y)[c], exact(x, y)[c], 1e-5);
      }
    }
  }
}

TEST(PhongChain, TakesTheReceiversCosineIntoItsExponent) {
  const Grid<Rgb> map = make_synthetic_map("checker", {32, 16}).radiance;
  const double exponents[] = {50.0, 8.0};
  const double one_more[] = {51.0, 9.0};
  const SpecularChain all_one = phong_chain(map, {16, 8}, exponents, PhongAxis::all_one);
  const SpecularChain shifted = phong_chain(map, {16, 8}, one_more);
  const SpecularChain by_reflection = phong_chain(map, {16, 8}, exponents);
  for (std::size_t level = 0; level < 2; ++level) {
    const Extent extent = {16 >> level, 8 >> level};
    const Grid<glm::dvec3> exact =
        reference::prefiltered(map, reference::phong_lobe(exponents[level]), extent);
    for (std::size_t i = 0; i < extent.count(); ++i) {
      EXPECT_EQ(all_one[level].values()[i], shifted[level].values()[i]);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(by_reflection[level].values()[i][c], exact.values()[i][c], 1e-5);
      }
    }
  }
}

/// Two levels whose values say where they come from.
SpecularChain numbered_chain() {
  SpecularChain chain = {Grid<Rgb>({4, 2}), Grid<Rgb>({2, 1})};
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      chain[0](x, y) = Rgb(static_cast<float>(x), static_cast<float>(y), 1.0F);
    }
  }
  chain[1](0, 0) = Rgb(10.0F, 0.0F, 3.0F);
  chain[1](1, 0) = Rgb(20.0F, 0.0F, 3.0F);
  return chain;
}

TEST(ChainLookUp, InterpolatesInALevelAndBetweenLevels) {
  const SpecularChain chain = numbered_chain();
  const auto at = [&](double s, double t, double level) {
    return look_up(chain, direction_from_square({s, t}), level);
  };
  // Roundings of a direction's position, on values of up to 20.
  constexpr float kRounding = 1e-5F;
  EXPECT_NEAR(at(1.5 / 4, 0.25, 0.0).r, 1.0F, kRounding) << "a texel's centre";
  EXPECT_NEAR(at(2.0 / 4, 0.25, 0.0).r, 1.5F, kRounding) << "between two columns";
  EXPECT_NEAR(at(1.5 / 4, 0.5, 0.0).g, 0.5F, kRounding) << "between two rows";
  EXPECT_NEAR(at(1e-9, 0.25, 0.0).r, 1.5F, kRounding) << "across the seam, between 3 and 0";
  EXPECT_NEAR(at(1.5 / 4, 0.01, 0.0).g, 0.0F, kRounding) << "clamped at the pole";
  EXPECT_NEAR(at(0.25, 0.5, 1.0).r, 10.0F, kRounding);
  EXPECT_NEAR(at(0.25, 0.5, 0.25).b, 1.5F, kRounding) << "a quarter of the way";
  EXPECT_NEAR(at(0.25, 0.5, 7.0).r, 10.0F, kRounding) << "clamped to the last level";
  EXPECT_NEAR(at(1.5 / 4, 0.25, -3.0).r, 1.0F, kRounding) << "clamped to the first level";
}

TEST(ChainLookUp, FindsTheLevelsOfTheirOwnRoughness) {
  const std::vector<double> roughness = level_roughness(9);
  for (int level = 0; level < 9; ++level) {
    EXPECT_DOUBLE_EQ(level_of_roughness(roughness[static_cast<std::size_t>(level)], 9), level);
  }
}

TEST(ChainLookUp, AsPublishedPassesTheLastLevel) {
  EXPECT_EQ(level_of_roughness_published(1.0, 9), 9.0) << "of levels 0 to 8";
  EXPECT_GT(level_of_roughness_published(0.5, 9), level_of_roughness(0.5, 9));
}

TEST(ChainInterpolation, StaysBelowItsBound) {
  for (const GgxWeight weight : {GgxWeight::cosine, GgxWeight::masking}) {
    for (int level = 0; level < 8; ++level) {
      const InterpolationError error =
          interpolation_error(level / 8.0, (level + 1) / 8.0, 40, weight);
      EXPECT_LE(error.largest, error.bound * (1.0 + 1e-9)) << level;
      EXPECT_GT(error.largest, 0.0) << level;
    }
  }
}

TEST(ChainInterpolation, IsTheErrorOfOneHarmonic) {
  // Degree 1 alone: a mirror's factor is 1, and those at the ends are mixed half and half.
  const auto factor = [](double roughness) {
    return roughness == 0.0 ? 1.0 : zonal_factors(*ggx_lobe(roughness), 1)[1];
  };
  double largest = 0.0;
  for (int i = 1; i < 32; ++i) {
    const double place = i / 32.0;
    const double mixed = (1.0 - place) * factor(0.5) + place * factor(0.75);
    largest = std::max(largest, std::abs(mixed - factor(0.5 + 0.25 * place)));
  }
  EXPECT_NEAR(interpolation_error(0.5, 0.75, 1).largest, largest, 1e-12);
}

TEST(ChainInterpolation, FallsWithTheSquareOfTheStep) {
  const double whole = interpolation_error(0.5, 0.75, 10).largest;
  const double half = interpolation_error(0.5, 0.625, 10).largest;
  EXPECT_GT(whole / half, 2.0);
  EXPECT_LT(whole / half, 8.0) << "four, but for the change of the second derivative";
}

}  // namespace
}  // namespace lightproof
