// The gate neither ends in an error nor rejects a sampler that is right, whatever the map:
// ci/robustness asks the same of the program, of many more maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "lightproof/cases/adversarial_maps.h"
#include "lightproof/gate/gate.h"

namespace lightproof {
namespace {

// Points are directed at the rows of the poles, however faint: the sampler's own sums, rounded to
// 2^-31, put such a row elsewhere than the exact ones.
TEST(Positions, OfAFaintRowAtThePoleAreAccepted) {
  EnvironmentMap map = {"faint pole", Grid<Rgb>({64, 32}, Rgb(1.0F)), {}};
  std::ranges::fill(map.radiance.row(31), Rgb(1e-5F));
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const char* name : {"guide_lines", "linear_scan"}) {
    samplers_under_test.push_back(
        sampler_under_test(sampler_by_name(name), DensitySpace::solid_angle));
  }
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 22U});
  for (const TestRecord& test : result.tests) {
    EXPECT_NE(test.outcome, Outcome::reject) << test.sampler << ": " << full_name(test.test);
  }
}

// An alias table cannot be asked for the points of a row: what is not tested is said.
TEST(Positions, InARowThatNoPointsCanBeDirectedAtAreRecordedAsNotRun) {
  const EnvironmentMap map = {"even", Grid<Rgb>({128, 64}, Rgb(1.0F)), {}};
  const std::vector<SamplerUnderTest> samplers_under_test = {
      sampler_under_test(sampler_by_name("alias"), DensitySpace::solid_angle),
      sampler_under_test(sampler_by_name("guide_lines"), DensitySpace::solid_angle)};
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 15U});
  std::size_t found = 0;
  for (const TestRecord& test : result.tests) {
    if (test.test != TestId::positions_first_row && test.test != TestId::positions_last_row) {
      continue;
    }
    ++found;
    EXPECT_EQ(test.outcome, test.sampler == "alias" ? Outcome::not_run : Outcome::accept);
    EXPECT_EQ(test.detail.find("no points can be directed there") != std::string::npos,
              test.sampler == "alias")
        << test.detail;
  }
  EXPECT_EQ(found, 4U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
}

int integer(std::mt19937& random, int from, int to) {
  return from + static_cast<int>(random() % static_cast<unsigned>(to - from + 1));
}

class Robustness : public testing::TestWithParam<AdversarialMap> {};

TEST_P(Robustness, NoCorrectSamplerIsRejectedOnSmallMaps) {
  const auto kind = static_cast<unsigned>(GetParam().name.size());
  std::mt19937 random(kind);
  std::vector<SamplerUnderTest> correct = all_samplers_under_test();
  std::erase_if(correct,
                [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
  for (int run = 0; run < 8; ++run) {
    // Maps of one row are those whose density changes most inside a texel.
    const int height = run % 4 == 0 ? 1 : integer(random, 1, 35);
    const Extent extent = {integer(random, 0, 1) == 0 ? 2 * height : integer(random, 1, 70),
                           height};
    EnvironmentMap map = make_adversarial_map(GetParam(), extent, random());
    constexpr std::array<float, 5> kScales = {1.0F, 1e-9F, 1e9F, 1e-33F, 1e24F};
    const float scale = kScales[static_cast<std::size_t>(integer(random, 0, 4))];
    for (Rgb& rgb : map.radiance.values()) rgb *= scale;
    const std::uint64_t samples = std::uint64_t{1}
                                  << static_cast<unsigned>(integer(random, 10, 15));
    const GateResult result = run_gate({&map, 1}, correct, {.samples = samples, .seed = random()});
    for (const TestRecord& test : result.tests) {
      EXPECT_NE(test.outcome, Outcome::reject)
          << test.sampler << " " << test.density_space << " on " << extent.width << "x"
          << extent.height << ", run " << run << ": " << full_name(test.test) << ": "
          << test.detail;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Maps, Robustness,
                         testing::ValuesIn(adversarial_maps().begin(), adversarial_maps().end()),
                         [](const auto& tested) {
                           std::string name(tested.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lightproof
