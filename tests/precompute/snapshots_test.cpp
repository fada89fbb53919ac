#include "lightproof/precompute/snapshots.h"

#include <gtest/gtest.h>

#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

PrecomputeRequest small_request() {
  PrecomputeRequest request;
  request.products = {{Product::irradiance, Extent{8, 4}},
                      {Product::reflectivity, Extent{16, 8}, 2},
                      {Product::specular, Extent{16, 8}, 2}};
  return request;
}

TEST(Snapshots, AreKeptAfterPowersOfTwoAndTheLastFrame) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {32, 16});
  const auto snapshots = make_snapshots(map, small_request(), {.frames = 6});
  std::vector<std::string> names;
  for (const PrecomputedMap& snapshot : snapshots) names.push_back(snapshot.name);
  EXPECT_EQ(names, (std::vector<std::string>{"irradiance-frame-1", "irradiance-frame-2",
                                             "irradiance-frame-4", "irradiance-frame-6",
                                             "reflectivity-frame-1", "reflectivity-frame-2",
                                             "reflectivity-frame-4", "reflectivity-frame-6"}));
}

// The error of a mean of N samples falls like N^(-1/2): to 1/8 over 64 times as many. 32 texels of
// a map of 8 x 4 know it to a quarter or so; a factor of two on either side is beyond chance.
TEST(Snapshots, ConvergeToTheExactMapLikeAMonteCarloEstimate) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  const auto snapshots = make_snapshots(map, small_request(), {.frames = 64});
  for (const std::size_t first : {0U, 7U}) {
    const double noisy = snapshots[first].errors[0]->error;
    const double smooth = snapshots[first + 6].errors[0]->error;
    EXPECT_GT(noisy / smooth, 4.0) << snapshots[first].name;
    EXPECT_LT(noisy / smooth, 16.0) << snapshots[first].name;
  }
}

TEST(Snapshots, OfAConstantMapAreExactAtOnce) {
  const EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  for (const PrecomputedMap& snapshot : make_snapshots(map, small_request(), {.frames = 1})) {
    for (const auto& error : snapshot.errors) EXPECT_LT(error->error, 1e-6) << snapshot.name;
  }
}

}  // namespace
}  // namespace lightproof
