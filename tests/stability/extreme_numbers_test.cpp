// Random numbers at the ends of their range and at every CDF entry: every sampler, point by point
// and in batches.
#include "lightproof/stability/extreme_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/cases/adversarial_points.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/stability/hard_maps.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

/// Widths that are no power of two, with texels without light at both ends and between.
EnvironmentMap gaps(Extent extent) {
  EnvironmentMap map = hard_maps::lognormal(extent, 1.5, 1);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const bool dark = x < 2 || x == extent.width - 1 || x % 5 == 3 ||
                        (extent.height > 2 && (y == 0 || y == extent.height - 1));
      if (dark) map.radiance(x, y) = Rgb(0.0F);
    }
  }
  return map;
}

/// All samplers of the registry that claim to be right, under all densities.
std::vector<SamplerUnderTest> corrected() {
  std::vector<SamplerUnderTest> methods;
  for (SamplerUnderTest& method : all_samplers_under_test()) {
    if (!method.known_defects) methods.push_back(std::move(method));
  }
  return methods;
}

class EverySampler : public testing::TestWithParam<SamplerUnderTest> {};

TEST_P(EverySampler, DrawsALitTexelAtEveryCdfEntryAndBesideIt) {
  const SamplerOnMap on_map(GetParam(), gaps({37, 11}));
  const CdfTable table(on_map.map(), {GetParam().target.density_space});
  std::vector<SquarePoint> points = adversarial_points(table);
  for (const SquarePoint u : adversarial_points_of_rows(table)) points.push_back(u);
  for (const double end : {0.0, 1.0 - 0x1p-24, 1.0 - 0x1p-53, 1.0}) {
    for (const double other : {0.0, 0.4, 1.0 - 0x1p-53, 1.0}) {
      points.insert(points.end(), {{end, other}, {other, end}});
    }
  }
  const Finding found = check_drawn(on_map, points);
  EXPECT_EQ(found.outcome, StabilityOutcome::right) << found.put_in << " -> " << found.came_out;
}

TEST_P(EverySampler, DrawsALitTexelAtEveryFloat) {
  const SamplerOnMap on_map(GetParam(), gaps({37, 5}));
  // All 2^24 of them in the thorough form; every 127th (a prime number) in the quick one.
  const FloatNumbers numbers = {.first = 0, .stride = test::is_thorough() ? 1U : 127U};
  for (const Coordinate coordinate : {Coordinate::s, Coordinate::t}) {
    const Finding found = check_every_float(on_map, coordinate, 0.43, numbers);
    EXPECT_EQ(found.outcome, StabilityOutcome::right) << found.put_in << " -> " << found.came_out;
  }
}

std::string name_of(const testing::TestParamInfo<SamplerUnderTest>& info) {
  return info.param.name + "_" + std::string(to_string(info.param.target.density_space));
}

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler, testing::ValuesIn(corrected()), name_of);

/// Those that give each row a run of the numbers of t, and each texel of it one of s.
std::vector<SamplerUnderTest> inverting() {
  std::vector<SamplerUnderTest> methods;
  for (const SamplerInfo& info : samplers()) {
    if (!info.inverts_rows || info.lookup != Lookup::nearest) continue;
    for (const DensitySpace density_space : kDensitySpaces) {
      methods.push_back(sampler_under_test(info, density_space));
    }
  }
  return methods;
}

class InvertingSampler : public testing::TestWithParam<SamplerUnderTest> {};

TEST_P(InvertingSampler, GivesEachTexelItsShareOfAllFloats) {
  const SamplerOnMap on_map(GetParam(), gaps({37, 5}));
  const FloatNumbers numbers = {.first = 0, .stride = test::is_thorough() ? 1U : 127U};
  for (const Coordinate coordinate : {Coordinate::s, Coordinate::t}) {
    const Finding found = check_counts(on_map, coordinate, 0.43, numbers);
    EXPECT_EQ(found.outcome, StabilityOutcome::right)
        << found.came_out << ", " << found.bound << " allowed";
  }
}

INSTANTIATE_TEST_SUITE_P(Samplers, InvertingSampler, testing::ValuesIn(inverting()), name_of);

TEST(NumberOne, CountsAsTheLastBelowItPointByPointAndInBatches) {
  const EnvironmentMap map = gaps({37, 11});
  const std::vector<SquarePoint> ones = {{1.0, 0.4}, {0.4, 1.0}, {1.0, 1.0}};
  constexpr double kLast = 1.0 - 0x1p-53;
  const std::vector<SquarePoint> lasts = {{kLast, 0.4}, {0.4, kLast}, {kLast, kLast}};
  for (const SamplerInfo& info : samplers()) {
    if (info.known_defects) continue;
    const AnySampler any = info.make(map, DensitySpace::solid_angle);
    std::visit(
        [&](const auto& sampler) {
          std::vector<TexelSample> batch(ones.size());
          sample(sampler, ones, std::span(batch));
          for (std::size_t i = 0; i < ones.size(); ++i) {
            const TexelSample expected = sampler.sample(lasts[i]);
            for (const TexelSample& found : {sampler.sample(ones[i]), batch[i]}) {
              EXPECT_EQ(found.x, expected.x) << info.name;
              EXPECT_EQ(found.y, expected.y) << info.name;
            }
          }
        },
        any);
  }
}

}  // namespace
}  // namespace lightproof
