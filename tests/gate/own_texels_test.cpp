// Maps whose texels are not those of latitude and longitude: the gate accepts every correct sampler
// on them, and kills and names mutants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lightproof/gate/gate.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/results/verdict.h"
#include "lightproof/samplers/light_sample.h"
#include "tests/gate/rejections.h"

namespace lightproof {
namespace {

using test::rejections;

struct Case {
  Mapping mapping;
  Extent extent;
};

std::vector<Case> cases() {
  return {{{MappingKind::octahedral}, {12, 12}},
          {{MappingKind::cube_strip}, {24, 4}},
          {node_mapping({16, 9}), {16, 9}},
          {{.shift = 0.5 / 15}, {15, 8}}};
}

TEST(OwnTexels, OfEveryMappingAreDrawnRightByEverySampler) {
  std::vector<SamplerUnderTest> correct = all_samplers_under_test();
  std::erase_if(correct, [](const SamplerUnderTest& each) { return each.known_defects; });
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    std::vector<EnvironmentMap> maps;
    for (const char* name : {"sun-sky"}) {
      maps.push_back(make_synthetic_map(name, each.extent, each.mapping));
    }
    const GateResult result = run_gate(maps, correct, {.samples = 1U << 16U});
    EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
        << testing::PrintToString(rejections(result));
    EXPECT_GT(result.tests.size(), 200U);
  }
}

// What a mapping does not allow is told, and nothing else is left out.
TEST(OwnTexels, TellWhichDensitiesTheyCannotHave) {
  const std::vector<SamplerUnderTest> all = all_samplers_under_test();
  const auto left_out_on_map = [&](const Mapping& mapping, Extent extent) {
    const EnvironmentMap map = make_synthetic_map("constant", extent, mapping);
    return left_out_on({&map, 1}, all);
  };
  EXPECT_TRUE(left_out_on_map({}, {8, 4}).empty());
  const auto is_bilinear = [](const LeftOut& each) { return each.sampler == "bilinear"; };
  const std::vector<LeftOut> octahedral = left_out_on_map({MappingKind::octahedral}, {8, 8});
  EXPECT_EQ(octahedral.size(), kDensities.size());
  EXPECT_TRUE(std::ranges::all_of(octahedral, is_bilinear));
  const std::vector<LeftOut> cube = left_out_on_map({MappingKind::cube_strip}, {24, 4});
  EXPECT_EQ(cube.size(), kDensities.size() + all.size() / kDensities.size() - 1);
  for (const LeftOut& each : cube) {
    EXPECT_TRUE(is_bilinear(each) || each.density_space == "B") << each.sampler;
    EXPECT_FALSE(each.reason.empty());
  }
}

TEST(OwnTexels, ADensityThatTheyCannotHaveIsRefused) {
  const EnvironmentMap map = make_synthetic_map("constant", {24, 4}, {MappingKind::cube_strip});
  EXPECT_ANY_THROW(sampler_by_name("alias").make(map, DensitySpace::solid_angle));
  EXPECT_ANY_THROW(sampler_by_name("bilinear").make(map, DensitySpace::texture));
}

// The direction of a sample is that of its point, and its density that over the square over the
// Jacobian: one at a time and in batches.
TEST(OwnTexels, SamplesAreDirectionsOfTheMapping) {
  const RandomStream stream("own-texels", 1);
  std::vector<SquarePoint> points;
  for (std::uint64_t i = 0; i < 1000; ++i) points.push_back(stream.point(i));
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    const EnvironmentMap map = make_synthetic_map("gradient", each.extent, each.mapping);
    for (const char* name : {"packed_alias", "guide_table", "linear_scan_published"}) {
      const AnySampler any = sampler_by_name(name).make(map, DensitySpace::sine_weighted);
      std::visit(
          [&](const auto& sampler) {
            std::vector<double> numbers(4 * points.size());
            std::vector<std::int32_t> places(2 * points.size());
            const auto part = [&](auto& all, std::size_t k) {
              return std::span(all).subspan(k * points.size(), points.size());
            };
            const DirectionBatch batch = {part(numbers, 0), part(numbers, 1), part(numbers, 2),
                                          part(numbers, 3), part(places, 0),  part(places, 1)};
            sample_directions(sampler, points, batch);
            for (std::size_t i = 0; i < points.size(); ++i) {
              const TexelSample sample = sampler.sample(points[i]);
              const Direction d = direction_at(each.mapping, sample.at);
              const double pdf = sample.pdf.value / solid_angle_per_square(each.mapping, sample.at);
              EXPECT_EQ(Direction(batch.x[i], batch.y[i], batch.z[i]), d);
              EXPECT_EQ(batch.pdf[i], pdf);
              EXPECT_EQ(sample_direction(sampler, points[i]).pdf.value, pdf);
            }
          },
          any);
    }
  }
}

}  // namespace
}  // namespace lightproof
