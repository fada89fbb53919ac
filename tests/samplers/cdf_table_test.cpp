#include "lightproof/samplers/cdf_table.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

std::vector<std::uint32_t> entries_of(const std::vector<double>& weights) {
  std::vector<std::uint32_t> entries(weights.size() + 1);
  quantise_cdf(weights, entries);
  return entries;
}

TEST(QuantiseCdf, EqualWeightsGiveEqualSteps) {
  const auto entries = entries_of({2.0, 2.0, 2.0, 2.0});
  EXPECT_EQ(entries,
            (std::vector<std::uint32_t>{0, kCdfOne / 4, kCdfOne / 2, kCdfOne / 4 * 3, kCdfOne}));
}

TEST(QuantiseCdf, ZeroWeightsGetNothingWhereverTheyAre) {
  const auto entries = entries_of({0.0, 1.0, 0.0, 0.0, 3.0, 0.0});
  EXPECT_EQ(entries[1], 0U);
  EXPECT_EQ(entries[2], entries[4]);
  EXPECT_EQ(entries[5], kCdfOne);
  EXPECT_EQ(entries[6], kCdfOne);
}

TEST(QuantiseCdf, FaintWeightsKeepOneUnitBesideASun) {
  std::vector<double> weights(8192, 1.0);
  weights[4000] = 1e15;
  const auto entries = entries_of(weights);
  for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_LT(entries[i], entries[i + 1]) << i;
  EXPECT_EQ(entries.back(), kCdfOne);
}

TEST(QuantiseCdf, ScaleChangesNothing) {
  std::vector<double> weights = {0.1, 7.0, 0.0, 1e-7, 3.3, 12.0};
  const auto entries = entries_of(weights);
  for (double& weight : weights) weight *= 0x1p-30;
  EXPECT_EQ(entries_of(weights), entries);
}

TEST(QuantiseCdf, BlackGivesZeros) {
  EXPECT_EQ(entries_of({0.0, 0.0}), (std::vector<std::uint32_t>{0, 0, 0}));
}

class CdfTableOnMaps : public testing::TestWithParam<std::tuple<std::string_view, DensitySpace>> {};

TEST_P(CdfTableOnMaps, MassesAreTheReferences) {
  const auto [name, density_space] = GetParam();
  for (const Extent extent :
       {Extent{1, 1}, Extent{2, 1}, Extent{1, 3}, Extent{33, 17}, Extent{128, 64}}) {
    const EnvironmentMap map = make_synthetic_map(name, extent);
    const TargetDensity target{density_space, kRec709};
    const CdfTable table(map, target);
    const Grid<double> exact = reference::texel_masses(map, target);
    // A CDF entry is off by less than a unit for rounding and one for every cell with light; a mass
    // is the product of two differences of two CDF entries.
    const double row_error = 2.0 * (extent.height + 2) * 0x1p-31;
    const double column_error = 2.0 * (extent.width + 2) * 0x1p-31;
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        EXPECT_NEAR(table.mass(x, y), exact(x, y), row_error + column_error);
        EXPECT_EQ(table.mass(x, y) > 0.0, exact(x, y) > 0.0) << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, CdfTableOnMaps,
    testing::Combine(testing::Values("constant", "one-texel", "gradient", "cosine-lobe", "step",
                                     "sun-sky", "checker", "black-first-row"),
                     testing::Values(DensitySpace::texture, DensitySpace::solid_angle)));

TEST(CdfTable, BlackMapIsRefusedByName) {
  EnvironmentMap map{"night", Grid<Rgb>({4, 2}), {}};
  try {
    const CdfTable table(map, {DensitySpace::texture, kRec709});
    FAIL() << "a black map was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("night"), std::string::npos);
  }
}

TEST(CdfTable, FourBytesAnEntry) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  const CdfTable table(map, {DensitySpace::texture, kRec709});
  constexpr std::size_t kAfter = 2;  // the last one, of all rows and of all columns
  EXPECT_EQ(table.bytes(), 4U * (65U * 32U + kAfter + 33U + kAfter));
}

}  // namespace
}  // namespace lightproof
