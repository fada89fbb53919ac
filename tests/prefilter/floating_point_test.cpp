// No operation of a prefilter gives NaN or an infinity: on a map with a sun of 1e9 over black, by
// the narrowest and the broadest lobes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/prefilter/prefilter.h"
#include "tests/core/trap_floating_point.h"

namespace lightproof {
namespace {

TEST(FloatingPoint, OfNoPrefilterGivesNaNOrInfinity) {
  Grid<Rgb> map({64, 32}, Rgb(0.0F));
  map(5, 31) = Rgb(1e9F, 0.0F, 1.0F);
  const std::vector<PrefilteredLevel> levels = {
      {std::nullopt, {16, 8}},
      {PhongLobe{1.0}, {8, 4}},
      {PhongLobe{1000.0}, {8, 4}},
      {GgxLobe{alpha_of_roughness(0.05)}, {8, 4}},
      {GgxLobe{1.0, GgxWeight::masking, 0.04}, {8, 4}},
      {HalfVectorLobe{half_vector_shininess(0.1), GeometryTerm::cook_torrance}, {8, 4}}};
  for (const PrefilterMethodInfo& info : prefilter_methods()) {
    SCOPED_TRACE(info.name);
    const test::TrapFloatingPoint trap;
    for (const Grid<Rgb>& level : prefilter(map, levels, {.method = info.method, .samples = 64})) {
      EXPECT_TRUE(std::ranges::all_of(level.values(), [](const Rgb& rgb) {
        return std::isfinite(rgb.r) && std::isfinite(rgb.g) && std::isfinite(rgb.b);
      }));
    }
  }
}

}  // namespace
}  // namespace lightproof
