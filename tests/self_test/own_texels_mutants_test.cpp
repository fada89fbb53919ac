// Mutants on maps whose texels are not those of latitude and longitude.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "lightproof/cases/adversarial_maps.h"
#include "lightproof/gate/gate.h"
#include "lightproof/self_test/mutant.h"

namespace lightproof {
namespace {

/// A quarter of what mutants_test.cpp draws; ci/own-texels draws more of every density.
constexpr std::uint64_t kSamples = std::uint64_t{1} << 18U;

/// The texels of the map of all mutants, cut to a mapping's shape.
EnvironmentMap mutant_map_on(const Mapping& mapping, Extent extent) {
  const EnvironmentMap whole = mutant_map();
  const Extent from = whole.radiance.extent();
  EnvironmentMap map{.name = "mutant-map", .radiance = Grid<Rgb>(extent), .mapping = mapping};
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      map.radiance(x, y) =
          whole.radiance(x * from.width / extent.width, y * from.height / extent.height);
    }
  }
  return map;
}

/// Mistakes with rows of latitude: a sine taken at another height, the rows of the poles, and the
/// measure in which positions inside a row are uniform. Texels of other mappings have none of
/// these.
const std::set<std::string> kOfRows = {
    "nan-at-pole",         "other-measure-in-texel", "other-measure-undeclared",
    "other-rows-at-poles", "sine-at-edge",           "sine-to-last-row",
    "sine-twice"};

/// Those, and a solid angle that was forgotten, where all texels have one.
std::set<std::string> of_unequal_areas_too() {
  std::set<std::string> all = kOfRows;
  all.insert({"no-sine", "pdf-per-steradian"});
  return all;
}

void expect_killed_and_named(const EnvironmentMap& map, const std::set<std::string>& meaningless) {
  SCOPED_TRACE(describe(map.mapping));
  std::vector<SamplerUnderTest> all;
  for (const Mutant& mutant : mutants()) {
    all.push_back(sampler_under_test(mutant, DensitySpace::sine_weighted));
  }
  const GateResult result = run_gate({&map, 1}, all, {.samples = kSamples});
  std::set<std::string> left_out;
  for (const LeftOut& each : result.left_out) left_out.insert(each.sampler);
  EXPECT_EQ(left_out, meaningless);
  for (const Mutant& mutant : mutants()) {
    const std::string name(mutant.name);
    if (left_out.contains(name)) continue;
    SCOPED_TRACE(name);
    const auto rejection = std::ranges::find_if(
        result.rejections, [&](const Rejection& r) { return r.sampler == name; });
    if (rejection == result.rejections.end()) {
      ADD_FAILURE() << "is not rejected";
      continue;
    }
    EXPECT_EQ(rejection->looks_like, mutant.diagnosis) << rejection->diagnosis;
    if (map.mapping.kind != MappingKind::octahedral &&
        map.mapping.kind != MappingKind::cube_strip) {
      continue;
    }
    EXPECT_THAT(rejection->diagnosis,
                testing::Not(testing::ContainsRegex("phi|theta|azimuth|degrees")));
  }
}

TEST(OwnTexelsMutants, AreKilledAndNamedOnAnOctahedralMap) {
  expect_killed_and_named(mutant_map_on({MappingKind::octahedral}, {48, 48}),
                          of_unequal_areas_too());
}

TEST(OwnTexelsMutants, AreKilledAndNamedOnACube) {
  expect_killed_and_named(mutant_map_on({MappingKind::cube_strip}, {96, 16}), kOfRows);
}

TEST(OwnTexelsMutants, AreKilledAndNamedAroundNodes) {
  expect_killed_and_named(mutant_map_on(node_mapping({64, 33}), {64, 33}), kOfRows);
}

TEST(OwnTexelsMutants, AreKilledAndNamedInShiftedColumns) {
  expect_killed_and_named(mutant_map_on({.shift = 0.5 / 63}, {63, 32}), {});
}

}  // namespace
}  // namespace lightproof
