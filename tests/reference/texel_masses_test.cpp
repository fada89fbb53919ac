#include "reference/texel_masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"
#include "maps.h"

namespace lightproof::reference {
namespace {

using testing::HasSubstr;

// Cosines of two edges cancel: an absolute rounding of 1e-16 of a band that is 1e-4 and more here,
// and as much again for the total.
constexpr double kRelative = 1e-11;

double sum_of(const Grid<double>& grid) {
  return std::accumulate(grid.values().begin(), grid.values().end(), 0.0);
}

/// Solid angle of a texel of row y over 4 pi, in 64 bits of precision.
double share_of_sphere(Extent extent, int y) {
  const long double pi = std::acos(-1.0L);
  const auto edge = [&](int row) {
    return -std::cos(pi * static_cast<long double>(row) / static_cast<long double>(extent.height));
  };
  return static_cast<double>((edge(y + 1) - edge(y)) / 2.0L /
                             static_cast<long double>(extent.width));
}

TEST(TexelMasses, SumToOneOnEveryMap) {
  for (const SyntheticMap& synthetic : synthetic_maps()) {
    for (const Extent extent : kExtents) {
      for (const DensitySpace density_space : kDensitySpaces) {
        const auto masses = texel_masses(synthetic.make(extent), {density_space});
        EXPECT_EQ(masses.extent(), extent);
        // 2048 additions at most.
        EXPECT_NEAR(sum_of(masses), 1.0, 2048 * 2.3e-16) << synthetic.name;
      }
    }
  }
}

TEST(TexelMasses, OfTheConstantMapAreEqualUnderA) {
  for (const Extent extent : kExtents) {
    const auto masses =
        texel_masses(make_synthetic_map("constant", extent), {DensitySpace::texture});
    const double exact = 1.0 / static_cast<double>(extent.count());
    for (const double mass : masses.values()) EXPECT_NEAR(mass, exact, kRelative * exact);
  }
}

TEST(TexelMasses, OfTheConstantMapAreSolidAnglesUnderB) {
  for (const Extent extent : kExtents) {
    const auto masses =
        texel_masses(make_synthetic_map("constant", extent), {DensitySpace::solid_angle});
    for (int y = 0; y < extent.height; ++y) {
      const double exact = share_of_sphere(extent, y);
      for (const double mass : masses.row(y)) EXPECT_NEAR(mass, exact, kRelative * exact);
    }
  }
}

TEST(TexelMasses, KeepTheirDigitsAtThePolesOfATallMap) {
  const Extent extent = {1, 4096};
  const auto masses =
      texel_masses(make_synthetic_map("constant", extent), {DensitySpace::solid_angle});
  for (const int y : {0, 1, 2047, 2048, 4094, 4095}) {
    // The polar band is 1.5e-7 of the sphere: 1e-16 of cancellation is 2e-9 of it.
    EXPECT_NEAR(masses(0, y) / share_of_sphere(extent, y), 1.0, 2e-9) << y;
  }
}

TEST(TexelMasses, FollowTheValuesAndNotTheExposure) {
  const Extent extent = {2, 2};
  for (const float scale : {1.0F, 1e-30F, 1e30F}) {
    const auto map = grey_map(extent, {1 * scale, 3 * scale, 0 * scale, 4 * scale});
    for (const DensitySpace density_space : kDensitySpaces) {
      // Both halves of the sphere are equal under all densities. A float has 24 bits.
      const auto masses = texel_masses(map, {density_space});
      EXPECT_NEAR(masses(0, 0), 0.125, 1e-7);
      EXPECT_NEAR(masses(1, 0), 0.375, 1e-7);
      EXPECT_EQ(masses(0, 1), 0.0);
      EXPECT_NEAR(masses(1, 1), 0.5, 1e-7);
    }
  }
}

TEST(TexelMasses, OfThreeRowsDifferBetweenTheWeightings) {
  // Bands of 60 degrees: a quarter, a half and a quarter of the sphere.
  const auto map = grey_map({1, 3}, {1, 2, 3});
  const auto a = texel_masses(map, {DensitySpace::texture});
  const auto b = texel_masses(map, {DensitySpace::solid_angle});
  const auto c = texel_masses(map, {DensitySpace::sine_weighted});
  const double of_a[] = {1.0 / 6.0, 2.0 / 6.0, 3.0 / 6.0};
  const double of_b[] = {1.0 / 8.0, 4.0 / 8.0, 3.0 / 8.0};
  for (int y = 0; y < 3; ++y) {
    EXPECT_NEAR(a(0, y), of_a[y], 1e-15);
    EXPECT_NEAR(b(0, y), of_b[y], 1e-15);
    EXPECT_EQ(c(0, y), b(0, y)) << "they differ inside texels alone";
  }
}

TEST(TexelMasses, UseTheDeclaredLuminance) {
  EnvironmentMap map{"colours", Grid<Rgb>({3, 1}), {}};
  map.radiance(0, 0) = {1, 0, 0};
  map.radiance(1, 0) = {0, 1, 0};
  map.radiance(2, 0) = {0, 0, 1};
  const auto rec709 = texel_masses(map, {DensitySpace::texture});
  const auto published = texel_masses(map, {DensitySpace::solid_angle, kPublishedLuminance});
  const double of_rec709[] = {0.2126, 0.7152, 0.0722};
  const double of_published[] = {0.2989, 0.5866, 0.1145};
  for (int x = 0; x < 3; ++x) {
    EXPECT_NEAR(rec709(x, 0), of_rec709[x], 1e-15);
    EXPECT_NEAR(published(x, 0), of_published[x], 1e-15);
  }
}

TEST(TexelMasses, OfABlackMapAreRefused) {
  for (const DensitySpace density_space : kDensitySpaces) {
    try {
      texel_masses(grey_map({2, 2}, {0, 0, 0, 0}), {density_space});
      ADD_FAILURE() << "nothing was thrown";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("grey"));
      EXPECT_THAT(error.what(), HasSubstr("black"));
    }
  }
}

TEST(Marginals, AreSumsOfRowsAndColumns) {
  Grid<double> masses({3, 2});
  std::iota(masses.values().begin(), masses.values().end(), 1.0);
  EXPECT_THAT(row_marginal(masses), testing::ElementsAre(6.0, 15.0));
  EXPECT_THAT(column_marginal(masses), testing::ElementsAre(5.0, 7.0, 9.0));
}

}  // namespace
}  // namespace lightproof::reference
