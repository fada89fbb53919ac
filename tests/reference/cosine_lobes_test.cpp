#include "reference/cosine_lobes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lightproof/core/measure.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

constexpr Direction kUp = {0.0, 0.0, 1.0};
constexpr Extent kCells = {256, 128};

double mass_above(const Grid<double>& masses, double least_t) {
  double sum = 0.0;
  for (int y = 0; y < masses.extent().height; ++y) {
    if (y < least_t * masses.extent().height) continue;
    const auto row = masses.row(y);
    sum = std::accumulate(row.begin(), row.end(), sum);
  }
  return sum;
}

// Within 60 degrees of the axis lie half of the hemisphere, three quarters of the cosine's
// distribution, and 1 - 2^-11 of the tenth power's.
TEST(CosineLobes, HoldTheShareOfTheirConeAroundZ) {
  for (const auto& [exponent, share] :
       {std::pair(0.0, 0.5), std::pair(1.0, 0.75), std::pair(10.0, 1.0 - 0x1p-11)}) {
    const CosineLobe lobe = {kUp, exponent, 1.0};
    // t = 2/3 is no row of 128; 192 rows have it.
    EXPECT_NEAR(mass_above(cell_masses({&lobe, 1}, {16, 192}), 2.0 / 3.0), share, 1e-14);
    EXPECT_NEAR(rosenblatt_point({&lobe, 1}, {0.3, 2.0 / 3.0}).marginal, 1.0 - share, 1e-14);
  }
}

TEST(CosineLobes, KnowTheirDensityOnTheAxisAndBeyondTheHorizon) {
  const CosineLobe lobes[] = {{kUp, 1.0, 0.25}, {{1.0, 0.0, 0.0}, 50.0, 0.75}};
  EXPECT_NEAR(density(lobes, kUp), 0.25 / kPi, 1e-16);
  EXPECT_NEAR(density(lobes, {1.0, 0.0, 0.0}), 0.75 * 51.0 / (2.0 * kPi), 1e-14);
  EXPECT_EQ(density(lobes, {-0.6, 0.0, -0.8}), 0.0);
}

// The closed form around +z and the quadrature around any other axis must be the same distribution:
// a lobe around +x, turned by hand, against one around +z.
TEST(CosineLobes, QuadratureAgreesWithTheClosedForm) {
  const CosineLobe up = {kUp, 20.0, 1.0};
  const CosineLobe nearly_up = {{1e-9, 0.0, 1.0}, 20.0, 1.0};
  const Grid<double> exact = cell_masses({&up, 1}, kCells);
  const Grid<double> numeric = cell_masses({&nearly_up, 1}, kCells);
  EXPECT_TRUE(is_around_z({&up, 1}));
  EXPECT_FALSE(is_around_z({&nearly_up, 1}));
  for (std::size_t i = 0; i < exact.values().size(); ++i) {
    ASSERT_NEAR(numeric.values()[i], exact.values()[i], 1e-6 * exact.values()[i] + 1e-12);
  }
}

TEST(CosineLobes, MassesAreTheDensityTimesTheSolidAngle) {
  const CosineLobe lobes[] = {{kUp, 1.0, 0.3}, {{0.6, 0.0, 0.8}, 12.0, 0.7}};
  const Grid<double> masses = cell_masses(lobes, {1024, 512});
  double sum = 0.0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) {
      sum += masses(x, y);
      if (x % 97 != 0 || y % 31 != 0) continue;
      const Direction centre = direction_from_square({(x + 0.5) / 1024, (y + 0.5) / 512});
      const double expected = density(lobes, centre) * texel_solid_angle({1024, 512}, y);
      // The midpoint rule is off by h^2/24 times the second derivative, n^2 at most.
      EXPECT_NEAR(masses(x, y), expected, 1e-3 * expected + 1e-9) << x << ", " << y;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(CosineLobes, GetCellsThatAreSmallAgainstTheLobe) {
  const CosineLobe wide = {kUp, 1.0, 1.0};
  const CosineLobe narrow = {kUp, 10000.0, 1.0};
  EXPECT_EQ(cells_for({&wide, 1}), (Extent{256, 128}));
  EXPECT_LE(2.0 * kPi / cells_for({&narrow, 1}).width, 0.25 * 0.01);
}

}  // namespace
}  // namespace lightproof::reference
