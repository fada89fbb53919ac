// Exact checks accept every correct sampler, whatever the size of the map and wherever its light
// is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/sampler_under_test.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

/// Light of a texel.
using Light = std::function<float(int x, int y)>;

EnvironmentMap map_of(Extent extent, const Light& light) {
  EnvironmentMap map = {"map", Grid<Rgb>(extent), {}};
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) map.radiance(x, y) = Rgb(light(x, y));
  }
  return map;
}

/// What the exact checks of a correct sampler say; empty if they accept.
std::string complaints(const EnvironmentMap& map, const SamplerUnderTest& under_test,
                       const Expectation& expectation) {
  const BoundSampler sampler = under_test.bind(map);
  const MassRounding rounding =
      under_test.rounding != nullptr ? under_test.rounding(map.radiance.extent()) : MassRounding{};
  const DensityComparison density = compare_density(sampler, expectation, rounding);
  std::string text;
  for (const CheckResult& check :
       {check_pdf_integral(integrate_pdf(sampler, expectation.smooth_cells())),
        check_support(density), check_declared_density(density)}) {
    if (!check.passed) text += full_name(check.test) + ": " + check.detail + "\n";
  }
  return text;
}

void expect_accepted(const EnvironmentMap& map, const std::string& what) {
  std::vector<SamplerUnderTest> samplers_under_test = all_samplers_under_test();
  std::erase_if(samplers_under_test,
                [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
  std::vector<std::string> found(samplers_under_test.size());
  for (const DensitySpace density_space : kDensitySpaces) {
    for (const Lookup lookup : {Lookup::nearest, Lookup::bilinear}) {
      const TargetDensity target = {density_space, kRec709, lookup};
      const Expectation expectation = expectation_of(map, target);
      parallel_for(samplers_under_test.size(), [&](std::size_t i) {
        if (samplers_under_test[i].target == target)
          found[i] = complaints(map, samplers_under_test[i], expectation);
      });
    }
  }
  for (std::size_t i = 0; i < samplers_under_test.size(); ++i) {
    EXPECT_EQ(found[i], "") << samplers_under_test[i].name << " "
                            << to_string(samplers_under_test[i].target.density_space) << " on "
                            << what << ", " << map.radiance.extent().width << "x"
                            << map.radiance.extent().height;
  }
}

// The rule with two nodes left 1.0e-6 here, and 2.7e-6 of the single texel: more than a correct pdf
// may be off.
TEST(ExactChecks, AcceptLightInTheRowOfAPole) {
  expect_accepted(map_of({40, 20}, [](int, int y) { return y == 19 ? 1000.0F : 1.0F; }),
                  "a bright pole row");
  for (const int height : {17, 32}) {
    expect_accepted(
        map_of({2 * height, height}, [](int x, int y) { return x == 3 && y == 0 ? 1.0F : 0.0F; }),
        "one lit texel at the pole");
  }
}

// In the quick form every height gets one of the three kinds of light, in turn.
TEST(ExactChecks, AcceptEveryHeightFrom1To70WithLightAnywhere) {
  const auto takes = [](int height, int kind) { return test::is_thorough() || height % 3 == kind; };
  for (int height = 1; height <= 70; ++height) {
    const RandomStream stream("ExactChecks.AcceptEveryHeight", static_cast<std::uint64_t>(height));
    const int width = 1 + static_cast<int>(140.0 * stream.point(0).s);
    const Extent extent = {width, height};
    const int lit_x = static_cast<int>(width * stream.point(1).s);
    const int lit_y = static_cast<int>(height * stream.point(1).t);
    if (takes(height, 0)) {
      expect_accepted(
          map_of(extent, [&](int x, int y) { return x == lit_x && y == lit_y ? 3.0F : 0.0F; }),
          "one lit texel");
    }
    if (takes(height, 1)) {
      expect_accepted(map_of(extent, [&](int, int y) { return y == height - 1 ? 1e4F : 1.0F; }),
                      "a bright last row");
    }
    if (takes(height, 2)) {
      expect_accepted(map_of(extent,
                             [&](int x, int y) {
                               const auto i = static_cast<std::uint64_t>(2 + x + y * width);
                               return static_cast<float>(std::exp(8.0 * stream.point(i).s));
                             }),
                      "noise over three orders of magnitude");
    }
  }
}

// t grows from the nadir to the zenith: one row more is one row above.
TEST(Inspection, NamesTheRowWhosePdfIsReturned) {
  const Extent extent = {16, 16};
  const EnvironmentMap map =
      map_of(extent, [](int x, int y) { return 1.0F + static_cast<float>(17 * y + x % 3); });
  const SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  const Expectation expectation = expectation_of(map, under_test.target);
  const auto name_at = [&](double rows) {
    BoundSampler sampler = under_test.bind(map);
    const BoundSampler right = under_test.bind(map);
    sampler.sample = [right, rows](std::span<const SquarePoint> points,
                                   std::span<TexelSample> samples) {
      right.sample(points, samples);
      for (TexelSample& sample : samples) {
        const double t = std::clamp(sample.at.t + rows / 16.0, 0.0, 1.0 - 0x1p-53);
        sample.pdf = right.pdf({sample.at.s, t});
      }
    };
    return inspect(sampler, expectation, {}).returned_pdf_of.value_or("nothing");
  };
  EXPECT_EQ(name_at(1.0), "one row above");
  EXPECT_EQ(name_at(-1.0), "one row below");
  EXPECT_EQ(name_at(0.0), "nothing");
}

}  // namespace
}  // namespace lightproof
