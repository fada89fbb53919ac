#include "lightproof/prefilter/irradiance_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/prefilter/two_sided_irradiance.h"
#include "reference/irradiance.h"
#include "tests/prefilter/maps.h"

namespace lightproof {
namespace {

/// Weights are differences of numbers up to 4, rounded to 2^-52, and so are running sums, relative
/// to the light of their row.
double rounding(const EnvironmentMap& map) { return 4e-15 * sum_of_texels(map); }

void expect_near(glm::dvec3 actual, glm::dvec3 expected, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance);
}

/// Holds the map of `normals` against the irradiance of each, at every so manieth row.
void expect_irradiances(Extent source, Extent normals, int rows = 1) {
  SCOPED_TRACE(testing::Message() << source.width << 'x' << source.height << " to " << normals.width
                                  << 'x' << normals.height);
  const EnvironmentMap map = random_map_with_sun(source);
  const IrradianceMap actual = irradiance_map(map, normals);
  ASSERT_EQ(actual.irradiance.extent(), normals);
  for (int y = 0; y < normals.height; y += rows) {
    for (int x = 0; x < normals.width; ++x) {
      const Direction normal =
          direction_from_square({(x + 0.5) / normals.width, (y + 0.5) / normals.height});
      expect_near(actual.irradiance(x, y), irradiance(map, normal).rgb, rounding(map));
    }
  }
}

TEST(IrradianceMap, HoldsTheIrradianceOfEveryNormal) {
  // Widths that divide each other, that share some divisors or none; odd and even ones; poles' rows
  // and a row at the horizon.
  const std::pair<Extent, Extent> sizes[] = {
      {{1, 1}, {1, 1}},    {{1, 1}, {4, 2}},   {{2, 1}, {2, 2}},    {{1, 2}, {3, 3}},
      {{3, 2}, {4, 4}},    {{3, 2}, {1, 1}},   {{4, 2}, {8, 4}},    {{7, 5}, {6, 3}},
      {{8, 4}, {4, 2}},    {{12, 6}, {8, 4}},  {{33, 17}, {16, 8}}, {{64, 32}, {16, 9}},
      {{30, 15}, {15, 7}}, {{60, 30}, {9, 5}}, {{64, 31}, {7, 4}},  {{30, 15}, {12, 6}},
      {{100, 50}, {10, 5}}};
  for (const auto& [source, normals] : sizes) expect_irradiances(source, normals);
}

TEST(IrradianceMap, OfTheSizesOfAnEngineHoldsTheIrradianceOfEveryNormal) {
  expect_irradiances({512, 256}, {64, 32}, 3);
  expect_irradiances({500, 250}, {64, 32}, 8);
}

TEST(IrradianceMap, SeesOneBrightTexelAtSeamAndPoles) {
  const Extent source = {64, 32};
  const Extent normals = {16, 8};
  for (const int x : {0, 31, 63}) {
    for (const int y : {0, 15, 16, 31}) {
      const EnvironmentMap map = one_lit_texel(source, x, y, 1e5F);
      const IrradianceMap actual = irradiance_map(map, normals);
      for (int j = 0; j < normals.height; ++j) {
        for (int i = 0; i < normals.width; ++i) {
          const double expected = 1e5 * reference::clamped_cosine_of_texel(
                                            source, x, y, normal_of_texel(normals, i, j));
          expect_near(actual.irradiance(i, j), glm::dvec3(expected), rounding(map));
        }
      }
    }
  }
}

TEST(IrradianceMap, OfASunOfOneTexelIsRightForEveryNormal) {
  // As an engine's map is made; the mean of E is a quarter of the light.
  const Extent source = {512, 256};
  const Extent normals = {64, 32};
  const int x = 170;
  const int y = 160;
  const IrradianceMap actual = irradiance_map(one_lit_texel(source, x, y, 1e5F), normals);
  const double mean = 1e5 * texel_solid_angle(source, y) / 4.0;
  double largest = 0.0;
  for (int j = 0; j < normals.height; ++j) {
    for (int i = 0; i < normals.width; ++i) {
      const double expected =
          1e5 * reference::clamped_cosine_of_texel(source, x, y, normal_of_texel(normals, i, j));
      largest = std::max(largest, std::abs(actual.irradiance(i, j).g - expected));
    }
  }
  // 4e-15 of the radiance, of which the mean is 3.7e-5.
  EXPECT_LT(largest / mean, 1.1e-10);
}

TEST(IrradianceMap, IsNeverNegative) {
  const IrradianceMap map = irradiance_map(one_lit_texel({64, 32}, 5, 20, 1e9F), {32, 16});
  for (const glm::dvec3 rgb : map.irradiance.values()) EXPECT_GE(rgb.r, 0.0);
}

TEST(IrradianceMap, HasTheSameBitsForAnyNumberOfThreads) {
  const EnvironmentMap map = random_map_with_sun({96, 48});
  const auto bits = [&](int threads) {
    const ThreadLimit limit(threads);
    return irradiance_map(map, {32, 16});
  };
  const IrradianceMap one = bits(1);
  for (const int threads : {2, 3}) {
    EXPECT_TRUE(std::ranges::equal(bits(threads).irradiance.values(), one.irradiance.values()));
  }
}

TEST(IrradianceMap, HasNoSizeThatItRefusesButNone) {
  const EnvironmentMap map = random_map({8, 4});
  try {
    irradiance_map(map, {0, 4});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("0 x 4"));
  }
  EXPECT_THROW(irradiance_map(map, {4, -1}), InputError);
}

TEST(TwoSidedIrradiance, IsThatOfACombFromAnyLongitude) {
  const EnvironmentMap map = random_map_with_sun({24, 12});
  const FoldedLattice lattice(map.radiance.extent());
  for (const int teeth : {1, 2, 3, 8, 24}) {
    for (const double first : {-7.0, 0.0, 0.9, 2.0, 3.1, 4.0, 5.9, 6.2, 9.5}) {
      for (const double tilt : {0.0, 0.1, 0.7, 1.3, 1.5, 0.5 * kPi}) {
        const NormalComb comb{{std::sin(tilt), std::cos(tilt)}, first, teeth};
        const auto both = two_sided_irradiance(map, lattice, std::span(&comb, 1));
        ASSERT_EQ(both.size(), static_cast<std::size_t>(teeth));
        for (std::size_t i = 0; i < both.size(); ++i) {
          const double phi = kPi - first - 2.0 * kPi * static_cast<double>(i) / teeth;
          const Direction normal = {std::sin(tilt) * std::cos(phi), std::sin(tilt) * std::sin(phi),
                                    std::cos(tilt)};
          expect_near(both[i].upper, irradiance(map, normal).rgb, rounding(map));
          expect_near(both[i].lower, irradiance(map, -normal).rgb, rounding(map));
        }
      }
    }
  }
}

TEST(Irradiances, AreThoseOfEachNormal) {
  for (const Extent source : kTryingExtents) {
    const EnvironmentMap map = random_map_with_sun(source);
    const std::vector<Direction> normals = trying_normals();
    const std::vector<Irradiance> actual = irradiances(map, normals);
    ASSERT_EQ(actual.size(), normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      expect_near(actual[i].rgb, irradiance(map, normals[i]).rgb, rounding(map));
    }
  }
  EXPECT_TRUE(irradiances(random_map({4, 2}), {}).empty());
}

TEST(Irradiances, OfMoreNormalsThanFitATableAreThoseOfEach) {
  // 64 MB of tables are some 2000 normals of this map.
  const EnvironmentMap map = random_map({2048, 4});
  const RandomStream stream("prefilter/many", 1);
  std::vector<Direction> normals;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    normals.push_back(direction_from_square(stream.point(i)));
  }
  const std::vector<Irradiance> actual = irradiances(map, normals);
  ASSERT_EQ(actual.size(), normals.size());
  for (std::size_t i = 0; i < normals.size(); i += 7) {
    expect_near(actual[i].rgb, irradiance(map, normals[i]).rgb, rounding(map));
  }
}

TEST(DiffuseMap, IsTheIrradianceOverPi) {
  const EnvironmentMap map{"constant", Grid<Rgb>({8, 4}, Rgb(0.25F)), {}};
  const DiffuseMap diffuse = diffuse_map(irradiance_map(map, {4, 2}));
  for (const glm::dvec3 rgb : diffuse.radiance.values()) EXPECT_NEAR(rgb.g, 0.25, 1e-14);
  const Grid<Rgb> floats = rounded(diffuse.radiance);
  ASSERT_EQ(floats.extent(), (Extent{4, 2}));
  for (const Rgb rgb : floats.values()) EXPECT_FLOAT_EQ(rgb.g, 0.25F);
  EXPECT_EQ(reflected_by_white({glm::dvec3(kPi)}).rgb, glm::dvec3(1.0));
}

TEST(IrradianceError, IsRelativeToTheMeanOfTheBrightestError) {
  IrradianceMap exact{Grid<glm::dvec3>({4, 2}, glm::dvec3(2.0, 4.0, 0.0))};
  IrradianceMap map = exact;
  map.irradiance(1, 0) += glm::dvec3(0.2, 0.2, 0.0);
  const IrradianceError error = error_of(map, exact);
  EXPECT_NEAR(error.largest, 0.1, 1e-15);
  // One of eight normals' cells, which all are as large.
  EXPECT_NEAR(error.root_mean_square, 0.1 / std::sqrt(8.0), 1e-15);
  EXPECT_EQ(error_of(exact, exact).largest, 0.0);
}

}  // namespace
}  // namespace lightproof
