#include "lightproof/precompute/precompute.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/precompute/inputs.h"
#include "lightproof/precompute/levels.h"

namespace lightproof {
namespace {

PrecomputeRequest everything(Projection projection, PrefilterMethod method) {
  PrecomputeRequest request;
  const Extent extent = is_cube(projection) ? Extent{8, 8} : Extent{16, 8};
  request.products = {{Product::irradiance, extent},
                      {Product::specular, extent, 3},
                      {Product::reflectivity, extent, 2},
                      {Product::brdf_map, Extent{8, 8}}};
  request.projection = projection;
  request.method = {method, 64, 4};
  return request;
}

class Precompute : public testing::Test {
 protected:
  Precomputation make(const PrecomputeRequest& request, std::size_t texels = 0) {
    return precompute(map_, request, {}, {texels, 1});
  }
  /// Goes on with what is kept.
  Precomputation resume(const PrecomputeRequest& request) {
    return precompute(map_, request,
                      {folder_ / "", inputs_of(map_, request), Unfinished::continued}, {});
  }
  std::filesystem::path kept(const std::string& name) const {
    return path_of({folder_ / std::string(kUnfinishedName), name, name});
  }
  EnvironmentMap map_ = make_synthetic_map("sun-sky", {32, 16});

 private:
  TemporaryFolder folder_;
};

TEST_F(Precompute, MakesEveryProductInEveryProjectionByEveryMethod) {
  for (const ProjectionInfo& projection : projections()) {
    for (const PrefilterMethodInfo& method : prefilter_methods()) {
      const Precomputation made = make(everything(projection.projection, method.method));
      ASSERT_EQ(made.maps.size(), 3U);
      for (const PrecomputedMap& map : made.maps) {
        EXPECT_TRUE(is_pyramid(map.map)) << map.name;
        EXPECT_EQ(map.map.projection, projection.projection);
        for (const MapLevel& level : map.map.levels) {
          for (const Grid<Rgb>& face : level.faces) {
            EXPECT_TRUE(std::all_of(face.values().begin(), face.values().end(),
                                    [](const Rgb& c) {
                                      return std::isfinite(c.r) && c.r >= 0.0F && c.g >= 0.0F &&
                                             c.b >= 0.0F;
                                    }))
                << map.name << " by " << method.name;
          }
        }
      }
      EXPECT_TRUE(made.brdf_map);
    }
  }
}

// A white sky of radiance 1 is reflected as 1 by every normalised lobe.
TEST_F(Precompute, KeepsAConstantMapConstant) {
  map_ = make_synthetic_map("constant", {32, 16});
  const float value = map_.radiance(0, 0).r;
  for (const PrefilterMethodInfo& method : prefilter_methods()) {
    const Precomputation made = make(everything(Projection::cube, method.method));
    for (const PrecomputedMap& map : made.maps) {
      for (const MapLevel& level : map.map.levels) {
        for (const Rgb& texel : level.faces[3].values()) {
          EXPECT_NEAR(texel.r / value, 1.0F, 1e-5F) << map.name << " by " << method.name;
        }
      }
    }
  }
}

TEST_F(Precompute, MeasuresItsErrorsOnRequest) {
  const PrecomputeRequest request = everything(Projection::lat_long, PrefilterMethod::fast);
  EXPECT_FALSE(largest_error(make(request)));
  const Precomputation exact = make(request, 50);
  EXPECT_EQ(exact.maps[1].errors.size(), 3U);
  EXPECT_LT(*largest_error(exact), 1e-3);
  // 64 samples for each texel of a sky with a sun are far off.
  const Precomputation noisy =
      make(everything(Projection::lat_long, PrefilterMethod::half_vector), 50);
  EXPECT_GT(*largest_error(noisy), 0.01);
}

TEST_F(Precompute, GoesOnWithKeptLevelsAndMakesTheSame) {
  const PrecomputeRequest request = everything(Projection::cube, PrefilterMethod::fast);
  const Precomputation whole = make(request);
  resume(request);
  ASSERT_TRUE(std::filesystem::remove(kept("specular-1")));
  const auto before = std::filesystem::last_write_time(kept("specular-2"));
  const Precomputation resumed = resume(request);
  EXPECT_TRUE(std::filesystem::exists(kept("specular-1")));
  EXPECT_EQ(std::filesystem::last_write_time(kept("specular-2")), before) << "made again";
  for (std::size_t i = 0; i < whole.maps.size(); ++i) {
    for (std::size_t k = 0; k < whole.maps[i].map.levels.size(); ++k) {
      const auto a = whole.maps[i].map.levels[k].faces[0].values();
      const auto b = resumed.maps[i].map.levels[k].faces[0].values();
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
  }
}

TEST_F(Precompute, IsTheSameForAnyNumberOfThreads) {
  const PrecomputeRequest request = everything(Projection::lat_long, PrefilterMethod::fast);
  const auto plans = plan_levels(request.products[1], request.projection);
  std::vector<std::vector<MapLevel>> made;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    made.push_back(make_levels(map_, request, plans));
  }
  for (std::size_t level = 0; level < plans.size(); ++level) {
    const auto a = made[0][level].faces[0].values();
    for (const std::size_t other : {1U, 2U}) {
      const auto b = made[other][level].faces[0].values();
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
  }
}

}  // namespace
}  // namespace lightproof
