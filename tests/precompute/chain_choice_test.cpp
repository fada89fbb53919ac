#include "lightproof/precompute/chain_choice.h"

#include <gtest/gtest.h>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

PrecomputeRequest request_in(Projection projection) {
  PrecomputeRequest request;
  request.projection = projection;
  return request;
}

TEST(ChainChoice, TakesTheSmallestChainForAConstantMap) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  const ChainChoice choice =
      choose_chain(map, request_in(Projection::lat_long), Product::specular, 1e-3, 1);
  EXPECT_EQ(choice.extent, (Extent{8, 4}));
  EXPECT_EQ(choice.levels, 2);
}

TEST(ChainChoice, NeedsMoreForASmallerError) {
  const EnvironmentMap map = make_synthetic_map("gradient", {128, 64});
  for (const Projection projection : {Projection::lat_long, Projection::cube}) {
    const PrecomputeRequest request = request_in(projection);
    const ChainChoice coarse = choose_chain(map, request, Product::irradiance, 0.03, 1);
    const ChainChoice fine = choose_chain(map, request, Product::irradiance, 0.003, 1);
    EXPECT_LT(coarse.extent.height, fine.extent.height) << info(projection).name;
    EXPECT_LE(coarse.look_up_error, 0.03);
    EXPECT_LE(fine.look_up_error, 0.003);
    EXPECT_EQ(fine.levels, 1);
  }
}

TEST(ChainChoice, AddsLevelsUntilRoughnessInBetweenIsRight) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  const PrecomputeRequest request = request_in(Projection::lat_long);
  const ChainChoice coarse = choose_chain(map, request, Product::reflectivity, 0.2, 1);
  const ChainChoice fine = choose_chain(map, request, Product::reflectivity, 0.02, 1);
  EXPECT_LT(coarse.levels, fine.levels);
  EXPECT_LE(fine.roughness_error, 0.02);
}

TEST(ChainChoice, SaysWhatCanBeHadWhereNothingSuffices) {
  const EnvironmentMap map = make_synthetic_map("one-texel", {64, 32});
  try {
    choose_chain(map, request_in(Projection::lat_long), Product::specular, 1e-5, 1);
    FAIL() << "one bright texel in a chain of few levels";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--max-error"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightproof
