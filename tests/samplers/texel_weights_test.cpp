// Weights that are computed when asked for are those of the grid.
#include "lightproof/samplers/texel_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/registry.h"

namespace lightproof {
namespace {

TEST(CellWeights, OfAMapAreThoseOfItsGrid) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {38, 19});
  for (const DensitySpace density_space : kDensitySpaces) {
    const Grid<double> grid = texel_weights(map, {density_space, kRec709});
    const CellWeights weights(map, {density_space, kRec709});
    ASSERT_EQ(weights.count(), grid.values().size());
    for (const std::size_t block : {1U, 7U, 38U, 100U, 722U}) {
      std::vector<double> some(block);
      for (std::size_t first = 0; first + block <= weights.count(); first += block) {
        weights.get(first, some);
        EXPECT_TRUE(std::ranges::equal(some, grid.values().subspan(first, block)));
      }
    }
  }
}

TEST(CellWeights, StoredOnesComeAsTheyAre) {
  const std::vector<double> stored = {3.0, 0.0, 5.0, 2.0};
  const CellWeights weights(stored);
  std::vector<double> some(2);
  weights.get(1, some);
  EXPECT_EQ(some, (std::vector<double>{0.0, 5.0}));
  EXPECT_EQ(weights.count(), 4U);
}

TEST(Samplers, RefuseAMapWithoutLightByName) {
  EnvironmentMap map = {"cellar", Grid<Rgb>({70, 35})};
  for (const SamplerInfo& info : samplers()) {
    SCOPED_TRACE(info.name);
    try {
      info.make(map, DensitySpace::texture);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string_view(error.what()).find("cellar"), std::string_view::npos);
    }
  }
  map.radiance(69, 34) = {0.0F, 1e-30F, 0.0F};
  for (const SamplerInfo& info : samplers()) {
    SCOPED_TRACE(info.name);
    EXPECT_NO_THROW(info.make(map, DensitySpace::texture));
  }
}

TEST(Samplers, RefuseAMapWhoseLuminanceIsNoDensity) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (const float value : {kNaN, kInfinity, -kInfinity, -20.0F}) {
    for (const Extent extent : {Extent{1, 1}, Extent{3, 2}, Extent{70, 35}}) {
      EnvironmentMap map = {"torn", Grid<Rgb>(extent, Rgb(1.0F))};
      map.radiance(extent.width - 1, extent.height - 1).g = value;
      for (const SamplerInfo& info : samplers()) {
        for (const DensitySpace density_space : kDensitySpaces) {
          SCOPED_TRACE(info.name);
          try {
            info.make(map, density_space);
            ADD_FAILURE() << "accepted " << value;
          } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("torn: texels have a luminance that is"));
          }
        }
      }
    }
  }
}

// A channel may be negative where the luminance is not: there is a density in proportion to it.
TEST(Samplers, TakeAnyLuminanceFromZeroOn) {
  EnvironmentMap map = {"odd", Grid<Rgb>({70, 35}, Rgb(0.0F))};
  map.radiance(5, 5) = Rgb(-1.0F, 1.0F, 0.0F);
  map.radiance(6, 5) = Rgb(std::numeric_limits<float>::max());
  map.radiance(7, 5) = Rgb(-0.0F);
  map.radiance(8, 5) = Rgb(std::numeric_limits<float>::denorm_min());
  for (const SamplerInfo& info : samplers()) {
    SCOPED_TRACE(info.name);
    EXPECT_NO_THROW(info.make(map, DensitySpace::texture));
  }
}

}  // namespace
}  // namespace lightproof
