#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"
#include "maps.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

constexpr Extent kBins[] = {{1, 1}, {16, 8}, {32, 16}, {16, 32}, {5, 7}};

double sum_of(const Grid<double>& grid) {
  return std::accumulate(grid.values().begin(), grid.values().end(), 0.0);
}

double share_of_sphere(Extent cells, int y) {
  const double low = std::cos(kPi * y / cells.height);
  const double high = std::cos(kPi * (y + 1) / cells.height);
  return 0.5 * (low - high) / cells.width;
}

/// The bin's share of the square under A, of the sphere under B; under C of the sphere, each row of
/// texels spread evenly over its height.
double exact_area(DensitySpace density_space, Extent texels, Extent bins, int y) {
  if (density_space == DensitySpace::texture) return 1.0 / static_cast<double>(bins.count());
  if (density_space == DensitySpace::solid_angle) return share_of_sphere(bins, y);
  double area = 0.0;
  for (int row = 0; row < texels.height; ++row) {
    const double from =
        std::max(static_cast<double>(y) / bins.height, static_cast<double>(row) / texels.height);
    const double to = std::min((y + 1.0) / bins.height, (row + 1.0) / texels.height);
    if (from >= to) continue;
    area += (to - from) * texels.height * share_of_sphere({bins.width, texels.height}, row);
  }
  return area;
}

Grid<double> masses_of(const EnvironmentMap& map, DensitySpace density_space, Extent bins) {
  return bin_masses(texel_masses(map, {density_space}), density_space, bins);
}

void expect_areas(const EnvironmentMap& map, DensitySpace density_space, Extent bins) {
  const auto masses = masses_of(map, density_space, bins);
  ASSERT_EQ(masses.extent(), bins);
  for (int y = 0; y < bins.height; ++y) {
    for (const double mass : masses.row(y)) {
      EXPECT_NEAR(mass, exact_area(density_space, map.radiance.extent(), bins, y), 1e-12);
    }
  }
}

TEST(BinMasses, OfTheConstantMapAreTheAreasOfTheBins) {
  for (const Extent extent : kExtents) {
    const EnvironmentMap map = make_synthetic_map("constant", extent);
    for (const Extent bins : kBins) {
      for (const DensitySpace density_space : kDensitySpaces)
        expect_areas(map, density_space, bins);
    }
  }
}

void expect_total_of_one(const EnvironmentMap& map) {
  for (const DensitySpace density_space : kDensitySpaces) {
    for (const Extent bins : kBins) {
      EXPECT_NEAR(sum_of(masses_of(map, density_space, bins)), 1.0, 1e-12) << map.name;
    }
  }
}

TEST(BinMasses, KeepTheTotalOfEveryMap) {
  for (const SyntheticMap& synthetic : synthetic_maps()) {
    for (const Extent extent : kExtents) expect_total_of_one(synthetic.make(extent));
  }
}

TEST(BinMasses, OfAsManyBinsAreTheTexelMasses) {
  const Extent extent = {33, 17};
  for (const DensitySpace density_space : kDensitySpaces) {
    const auto texels = texel_masses(make_synthetic_map("gradient", extent), {density_space});
    const auto bins = bin_masses(texels, density_space, extent);
    for (std::size_t i = 0; i < extent.count(); ++i) {
      EXPECT_NEAR(bins.values()[i], texels.values()[i], 1e-15);
    }
  }
}

TEST(BinMasses, ShareATexelOverSInProportionToWidth) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const auto bins = masses_of(grey_map({2, 1}, {1, 3}), density_space, {3, 1});
    EXPECT_NEAR(bins(0, 0), 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(bins(1, 0), 1.0 / 12.0 + 1.0 / 4.0, 1e-15);
    EXPECT_NEAR(bins(2, 0), 1.0 / 2.0, 1e-15);
  }
}

TEST(BinMasses, ShareATexelOverTInProportionToItsMeasure) {
  // Two hemispheres of masses 1/4 and 3/4 in three bands of 60 degrees. Under A an equator texel
  // gives a third to the middle band; under B, whose bands are 1/4, 1/2, 1/4 of the sphere, half.
  const EnvironmentMap map = grey_map({1, 2}, {1, 3});
  const auto a = masses_of(map, DensitySpace::texture, {1, 3});
  EXPECT_NEAR(a(0, 0), 2.0 / 3.0 / 4.0, 1e-15);
  EXPECT_NEAR(a(0, 1), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(a(0, 2), 2.0 / 4.0, 1e-15);
  const auto b = masses_of(map, DensitySpace::solid_angle, {1, 3});
  EXPECT_NEAR(b(0, 0), 0.5 / 4.0, 1e-15);
  EXPECT_NEAR(b(0, 1), 0.5, 1e-15);
  EXPECT_NEAR(b(0, 2), 1.5 / 4.0, 1e-15);
}

TEST(BinMasses, OfOneTexelAreZeroOutsideIt) {
  // The lit texel (2, 3) of 7 x 5: s in [2/7, 3/7), t in [3/5, 4/5).
  const EnvironmentMap map = make_synthetic_map("one-texel", {7, 5});
  for (const DensitySpace density_space : kDensitySpaces) {
    const auto bins = masses_of(map, density_space, {14, 20});
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 14; ++x) {
        // Edges that coincide on paper may differ by an ulp: no more than that leaks.
        const bool inside = x >= 4 && x < 6 && y >= 12 && y < 16;
        EXPECT_EQ(bins(x, y) > 1e-14, inside) << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace lightproof::reference
