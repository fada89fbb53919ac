#include "lightproof/precompute/request.h"

#include <gtest/gtest.h>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

TEST(PlanLevels, HalvesASpecularChainFromTheMirrorToFullRoughness) {
  const auto plans = plan_levels({Product::specular, Extent{64, 32}, 5}, Projection::lat_long);
  ASSERT_EQ(plans.size(), 5U);
  EXPECT_FALSE(plans[0].lobe) << "roughness 0 is the mirror";
  for (int i = 0; i < 5; ++i) {
    const LevelPlan& plan = plans[static_cast<std::size_t>(i)];
    EXPECT_EQ(plan.extent, (Extent{64 >> i, 32 >> i}));
    EXPECT_DOUBLE_EQ(*plan.roughness, i / 4.0);
  }
  EXPECT_DOUBLE_EQ(std::get<GgxLobe>(*plans[2].lobe).alpha, 0.25) << "the roughness squared";
}

TEST(PlanLevels, PutsReflectivityLevelsInTheMiddleOfEqualSpansOfRoughness) {
  const auto plans =
      plan_levels({Product::reflectivity, Extent{128, 64}, std::nullopt}, Projection::lat_long);
  ASSERT_EQ(plans.size(), 7U);
  EXPECT_DOUBLE_EQ(*plans[3].roughness, 0.5);
  EXPECT_NEAR(std::get<HalfVectorLobe>(*plans[3].lobe).shininess, 30.0, 1e-12) << "2/R^4 - 2";
}

TEST(PlanLevels, GivesAnIrradianceMapOneLevelWithoutRoughness) {
  const auto plans = plan_levels({Product::irradiance}, Projection::cube);
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].extent, (Extent{16, 16}));
  EXPECT_FALSE(plans[0].roughness);
}

TEST(PlanLevels, TakesNoMoreLevelsThanASizeHas) {
  EXPECT_EQ(
      plan_levels({Product::specular, Extent{8, 4}, std::nullopt}, Projection::lat_long).size(),
      4U);
  EXPECT_THROW(plan_levels({Product::specular, Extent{8, 4}, 5}, Projection::lat_long), InputError);
  EXPECT_THROW(plan_levels({Product::specular, Extent{8, 4}, 0}, Projection::lat_long), InputError);
  EXPECT_THROW(plan_levels({Product::specular, Extent{8, 4}, 1}, Projection::cube), InputError)
      << "faces are square";
}

TEST(Masking, IsFoundByItsName) {
  for (const Masking masking : {Masking::karis, Masking::separable, Masking::height_correlated}) {
    EXPECT_EQ(masking_by_name(name_of(masking)), masking);
  }
  EXPECT_THROW(masking_by_name("smith"), InputError);
}

}  // namespace
}  // namespace lightproof
