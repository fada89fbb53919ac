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

void expect_killed_and_named(const EnvironmentMap& map) {
  SCOPED_TRACE(describe(map.mapping));
  std::vector<SamplerUnderTest> all;
  for (const Mutant& mutant : mutants()) {
    all.push_back(sampler_under_test(mutant, DensitySpace::sine_weighted));
  }
  const GateResult result = run_gate({&map, 1}, all, {.samples = 1U << 20U});
  std::set<std::string> left_out;
  for (const LeftOut& each : result.left_out) left_out.insert(each.sampler);
  EXPECT_LT(left_out.size(), 12U);
  for (const Mutant& mutant : mutants()) {
    const std::string name(mutant.name);
    if (left_out.contains(name)) continue;
    SCOPED_TRACE(name);
    const auto rejection = std::ranges::find_if(
        result.rejections, [&](const Rejection& r) { return r.sampler == name; });
    ASSERT_NE(rejection, result.rejections.end());
    EXPECT_EQ(rejection->looks_like, mutant.diagnosis);
  }
}

TEST(OwnTexelsMutants, AreKilledAndNamedOnAnOctahedralMap) {
  expect_killed_and_named(mutant_map_on({MappingKind::octahedral}, {48, 48}));
}

TEST(OwnTexelsMutants, AreKilledAndNamedOnACube) {
  expect_killed_and_named(mutant_map_on({MappingKind::cube_strip}, {96, 16}));
}

}  // namespace
}  // namespace lightproof
