// What the gate says of samplers that declare a bilinear look-up: of the correct one, of those of
// the other look-up, and of two that go wrong at the edges of the map only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "lightproof/gate/gate.h"
#include "lightproof/image/synthetic.h"
#include "tests/gate/rejections.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

using test::rejections;

GateResult gate(const EnvironmentMap& map, const SamplerUnderTest& under_test,
                std::uint64_t samples = std::uint64_t{1} << 18U) {
  return run_gate({&map, 1}, {&under_test, 1}, {.samples = samples});
}

SamplerUnderTest bilinear(DensitySpace density_space) {
  return sampler_under_test(sampler_by_name("bilinear"), density_space);
}

TEST(BilinearGate, AcceptsMapsOfAwkwardShapes) {
  for (const Extent extent : {Extent{1, 2}, Extent{1, 7}, Extent{9, 1}, Extent{6, 5}}) {
    for (const char* name : {"sun-sky", "one-texel"}) {
      const EnvironmentMap map = make_synthetic_map(name, extent);
      for (const DensitySpace density_space : kDensitySpaces) {
        const GateResult result = gate(map, bilinear(density_space));
        EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
            << name << ", " << extent.width << "x" << extent.height << ": "
            << testing::PrintToString(rejections(result));
      }
    }
  }
}

TEST(BilinearGate, TheLookUpThatASamplerDeclaresIsHeldAgainstIt) {
  const EnvironmentMap map = make_synthetic_map("checker", kExtent);
  for (const DensitySpace density_space : kDensitySpaces) {
    SamplerUnderTest interpolates = bilinear(density_space);
    interpolates.target.lookup = Lookup::nearest;
    SamplerUnderTest takes_texels =
        sampler_under_test(sampler_by_name("hierarchical"), density_space);
    takes_texels.target.lookup = Lookup::bilinear;
    for (const SamplerUnderTest& under_test : {interpolates, takes_texels}) {
      const GateResult result = gate(map, under_test);
      EXPECT_THAT(rejections(result), testing::IsSupersetOf({"reference/texels"}))
          << under_test.name;
      ASSERT_EQ(result.rejections.size(), 1U);
      EXPECT_EQ(result.rejections[0].looks_like, "other-lookup") << under_test.name;
    }
  }
}

/// A sampler made of the correct one of another map: its positions and densities are moved by
/// `back`, and asked for by `there`.
template <class Back, class There>
SamplerUnderTest changed(DensitySpace density_space, EnvironmentMap (*other)(const EnvironmentMap&),
                         const Back& back, const There& there) {
  SamplerUnderTest under_test = bilinear(density_space);
  under_test.bind = [bind = under_test.bind, other, back, there](const EnvironmentMap& map) {
    const auto kept = std::make_shared<const EnvironmentMap>(other(map));
    const BoundSampler correct = bind(*kept);
    const Extent extent = map.radiance.extent();
    return BoundSampler{[correct, back, extent, kept](std::span<const SquarePoint> points,
                                                      std::span<TexelSample> samples) {
                          correct.sample(points, samples);
                          for (TexelSample& sample : samples) {
                            sample.at = back(sample.at);
                            sample.x = cell_of(sample.at.s, extent.width);
                            sample.y = cell_of(sample.at.t, extent.height);
                          }
                        },
                        [correct, there](SquarePoint at) { return correct.pdf(there(at)); }};
  };
  return under_test;
}

/// The map and its mirror image, side by side: at both seams a column meets itself.
EnvironmentMap beside_its_mirror_image(const EnvironmentMap& map) {
  const auto [width, height] = map.radiance.extent();
  EnvironmentMap both = {map.name, Grid<Rgb>({2 * width, height})};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      both.radiance(x, y) = both.radiance(2 * width - 1 - x, y) = map.radiance(x, y);
    }
  }
  return both;
}

/// Twice as bright on one side of the seam as on the other.
EnvironmentMap ramp() {
  EnvironmentMap map = {"ramp", Grid<Rgb>(kExtent)};
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      map.radiance(x, y) = Rgb(1.0F + static_cast<float>(x) / static_cast<float>(kExtent.width));
    }
  }
  return map;
}

// The half columns at the seam are constant, where they should go over into each other: the first
// column gets 1 in place of 7/8 + 2/8, about ten standard deviations of its 5500 samples.
TEST(BilinearGate, RejectsASamplerThatForgetsToWrapAtTheSeam) {
  const EnvironmentMap map = ramp();
  for (const DensitySpace density_space : kDensitySpaces) {
    const SamplerUnderTest under_test = changed(
        density_space, beside_its_mirror_image,
        [](SquarePoint at) {
          return SquarePoint{2.0 * std::min(at.s, 1.0 - at.s), at.t};
        },
        [](SquarePoint at) {
          return SquarePoint{0.5 * at.s, at.t};
        });
    const GateResult result = gate(map, under_test, 1U << 20U);
    EXPECT_THAT(rejections(result), testing::Contains("reference/columns"));
  }
}

EnvironmentMap on_its_side(const EnvironmentMap& map) {
  const auto [width, height] = map.radiance.extent();
  EnvironmentMap turned = {map.name, Grid<Rgb>({height, width})};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) turned.radiance(y, x) = map.radiance(x, y);
  }
  return turned;
}

// On a map that depends on t alone it is correct but for the half rows at the poles, which go over
// into each other.
TEST(BilinearGate, RejectsASamplerThatWrapsAtThePoles) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const auto turn = [](SquarePoint at) { return SquarePoint{at.t, at.s}; };
  const SamplerUnderTest under_test = changed(DensitySpace::texture, on_its_side, turn, turn);
  const GateResult result = gate(map, under_test, 1U << 20U);
  EXPECT_THAT(rejections(result), testing::Contains("reference/rows"));
}

}  // namespace
}  // namespace lightproof
