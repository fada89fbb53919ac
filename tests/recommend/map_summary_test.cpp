// A map's summary against closed forms, sums over texels and exact moments.
#include "lightproof/recommend/map_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/rounded_table.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "maps.h"
#include "reference/estimator_moments.h"

namespace lightproof {
namespace {

double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(MapSummary, OfAConstantSkyHasClosedForms) {
  const MapSummary summary = summarise(make_synthetic_map("constant", {64, 32}));
  EXPECT_NEAR(summary.light, kSphere, 1e-12);
  EXPECT_NEAR(summary.square, kSphere, 1e-12);
  EXPECT_NEAR(summary.effective_fraction, 1.0, 1e-12);
  EXPECT_NEAR(summary.max_over_mean, 1.0, 1e-12);
  EXPECT_NEAR(summary.square_mean, 1.0, 1e-12);
  EXPECT_NEAR(summary.power(0), kSphere, 1e-6);
  for (int l = 1; l <= MapSummary::kDegree; ++l) EXPECT_NEAR(summary.power(l), 0.0, 1e-12);
  EXPECT_NEAR(summary.light_above_half, 0.5 * kSphere, 1e-6);
  EXPECT_NEAR(summary.light_above_mean, 0.0, 1e-6);
  for (const double added : summary.reduced_variance) EXPECT_NEAR(added, 0.0, 1e-12);
}

// All light in one texel: it fills the texel's share of the sphere, and there is no doubt where.
TEST(MapSummary, OfOneTexelHasClosedForms) {
  const EnvironmentMap map = make_synthetic_map("one-texel", {64, 32});
  const MapFigures figures = figures_of(map);
  const double area = texel_solid_angle({64, 32}, figures.peak_row);
  const MapSummary summary = summarise(map);
  EXPECT_NEAR(summary.light, area * figures.peak_luminance, 1e-12 * summary.light);
  EXPECT_NEAR(summary.effective_fraction, area / kSphere, 1e-15);
  EXPECT_NEAR(summary.effective_texels, 1.0, 1e-12);
  EXPECT_NEAR(summary.entropy, 0.0, 1e-12);
  EXPECT_NEAR(summary.max_over_mean, kSphere / area, 1e-9);
  // A point of light has (2l+1)/4pi G^2 in every degree; a texel of pi/32 has nearly that in low
  // ones: (l pi/32)^2/12 of it, 5 % at l = 8, is lost over each of its sides.
  for (int l = 0; l <= MapSummary::kDegree; ++l) {
    const double of_point = (2.0 * l + 1.0) / kSphere * summary.light * summary.light;
    EXPECT_LE(summary.power(l), of_point * (1.0 + 1e-12));
    EXPECT_GE(summary.power(l), of_point * 0.85);
  }
}

// Equal masses in two texels out of many: one bit.
TEST(MapSummary, CountsTexelsAndBits) {
  EnvironmentMap map{"two", Grid<Rgb>({16, 8})};
  map.radiance(3, 4) = map.radiance(11, 4) = Rgb(2.0F);
  const MapSummary summary = summarise(map);
  EXPECT_NEAR(summary.effective_texels, 2.0, 1e-12);
  EXPECT_NEAR(summary.entropy, 1.0, 1e-12);
}

/// Sizes that are powers of two, that are not, that are smaller than the blocks, and larger than
/// the finest grid, by a whole factor and by none.
constexpr Extent kSizes[] = {{256, 128}, {320, 160},   {33, 17},   {7, 5},
                             {1, 1},     {2048, 1024}, {1500, 600}};

TEST(MapSummary, CellsHoldAllLightOfAnySize) {
  for (const Extent extent : kSizes) {
    const EnvironmentMap map = random_map(extent, 2.0);
    const MapSummary summary = summarise(map);
    // Floats of the finest grid.
    EXPECT_NEAR(sum_of(summary.cells.light) / summary.light, 1.0, 1e-6);
    EXPECT_NEAR(sum_of(summary.cells.square) / summary.square, 1.0, 1e-6);
    EXPECT_NEAR(sum_of(summary.cells.solid_angle), kSphere, 1e-9);
    EXPECT_NEAR(sum_of(summary.product_light.values()) / summary.light, 1.0, 1e-6);
    EXPECT_NEAR(summary.quadtree_light.front().values().front() / summary.light, 1.0, 1e-6);
    EXPECT_NEAR(sum_of(summary.quadtree_area.back().values()), kSphere, 1e-9);
    for (std::size_t i = 0; i < summary.cells.size(); ++i) {
      const Direction d = {summary.cells.x[i], summary.cells.y[i], summary.cells.z[i]};
      ASSERT_NEAR(glm::length(d), 1.0, 1e-12);
    }
    EXPECT_EQ(summary.blocks.back().end_cell, summary.cells.size());
  }
}

// With k = 1 the sums over cells are the moments themselves.
TEST(MapSummary, SecondMomentsAreThoseOfEveryDensity) {
  const EnvironmentMap map = random_map({256, 128}, 2.0);
  const MapSummary summary = summarise(map);
  const Grid<double> luminance = luminance_of(map);
  const reference::Kernel one = {[](Direction) {
                                   return reference::KernelValue{1.0, 0.0};
                                 },
                                 [](Direction, double) { return false; }};
  const auto exact = reference::light_moments(one, std::span(&luminance, 1)).front();
  const auto second = [&](TableDensity density) {
    return sum_of(summary.cells.second[static_cast<std::size_t>(density)]);
  };
  EXPECT_NEAR(
      second(TableDensity::texture_space) / exact[reference::SampledDensity::texture_space].raw[1],
      1.0, 1e-6);
  EXPECT_NEAR(
      second(TableDensity::sine_weighted) / exact[reference::SampledDensity::sine_weighted].raw[1],
      1.0, 1e-6);
  for (std::size_t i = 0; i < kReductions.size(); ++i) {
    const double added = reduced_table_variance(map, kReductions[i]);
    EXPECT_NEAR(summary.reduced_variance[i], added, 1e-12);
    const double of_cells = sum_of(summary.cells.second[2 + i]);
    EXPECT_NEAR(of_cells / (summary.light * summary.light), 1.0 + added, 1e-5);
  }
  EXPECT_EQ(summary.half_float_variance, rounded_table_variance(map, MassForm::half));
  EXPECT_EQ(summary.byte_variance, rounded_table_variance(map, MassForm::byte));
}

// What compensation takes off may be any share of the mean.
TEST(MapSummary, KnowsTheLightAboveAnyShareOfTheMean) {
  const EnvironmentMap map = random_map({64, 32}, 2.0);
  const Grid<double> luminance = luminance_of(map);
  const MapSummary summary = summarise(map);
  for (const double share : {0.0, 0.25, 0.5, 0.8, 1.0, 3.0}) {
    const double floor = share * summary.light / kSphere;
    double above = 0.0;
    for (int y = 0; y < 32; ++y) {
      for (const double value : luminance.row(y)) {
        above += std::max(0.0, value - floor) * texel_solid_angle({64, 32}, y);
      }
    }
    EXPECT_NEAR(summary.light_above(share) / above, 1.0, 1e-6) << share;
  }
}

TEST(MapSummary, FollowsTheMapsOwnWeights) {
  EnvironmentMap map = make_synthetic_map("checker", {64, 32});
  map.weights = {1.0, 0.0, 0.0};
  const MapSummary summary = summarise(map);
  const MapFigures figures = figures_of(map);
  EXPECT_NEAR(summary.light / kSphere, figures.mean_luminance, 1e-12);
  EXPECT_NEAR(summary.effective_fraction, figures.effective_fraction, 1e-12);
  EXPECT_NEAR(summary.harmonics[0], summary.light / std::sqrt(kSphere), 1e-6);
}

TEST(MapSummary, IsTheSameWithAnyNumberOfThreads) {
  const EnvironmentMap map = random_map({320, 160}, 3.0);
  const auto summarised = [&](int threads) {
    const ThreadLimit limit(threads);
    return summarise(map);
  };
  const MapSummary one = summarised(1);
  const MapSummary two = summarised(2);
  EXPECT_EQ(one.light, two.light);
  EXPECT_EQ(one.entropy, two.entropy);
  EXPECT_EQ(one.harmonics, two.harmonics);
  EXPECT_EQ(one.cells.light, two.cells.light);
  EXPECT_EQ(one.cells.x, two.cells.x);
  EXPECT_EQ(one.cells.second, two.cells.second);
  EXPECT_EQ(one.light_above_mean, two.light_above_mean);
}

TEST(MapSummary, OfABlackMapHasNoLight) {
  const MapSummary summary = summarise({"black", Grid<Rgb>({16, 8})});
  EXPECT_FALSE(summary.has_light());
  EXPECT_EQ(summary.effective_fraction, 0.0);
  EXPECT_EQ(summary.entropy, 0.0);
}

}  // namespace
}  // namespace lightproof
