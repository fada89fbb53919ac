// The gate neither ends in an error nor rejects a sampler that is right, whatever the map:
// ci/robustness asks the same of the program, of many more maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "lightproof/suite/gate.h"

namespace lightproof {
namespace {

using Random = std::mt19937;

int integer(Random& random, int from, int to) {
  return from + static_cast<int>(random() % static_cast<unsigned>(to - from + 1));
}
float unit(Random& random) { return static_cast<float>(random()) * 0x1p-32F; }

using Paint = void (*)(Grid<Rgb>&, Random&);

void lamps(Grid<Rgb>& picture, Random& random, bool mirrored) {
  const auto [width, height] = picture.extent();
  for (int i = integer(random, 1, 3); i > 0; --i) {
    const int x = integer(random, 0, width - 1);
    const int y = integer(random, 0, height - 1);
    const Rgb light(std::exp(6.0F * unit(random)));
    picture(x, y) = light;
    if (mirrored) picture(x, height - 1 - y) = light;
  }
}

constexpr std::array<Paint, 6> kPaints = {
    [](Grid<Rgb>& picture, Random& random) { lamps(picture, random, false); },
    [](Grid<Rgb>& picture, Random& random) { lamps(picture, random, true); },
    [](Grid<Rgb>& picture, Random& random) {
      for (Rgb& rgb : picture.values()) rgb = Rgb(std::exp(8.0F * unit(random)));
    },
    [](Grid<Rgb>& picture, Random& random) {  // black rows
      const int period = integer(random, 2, 5);
      for (int y = 1; y < picture.extent().height; ++y) {
        if (y % period == 0) continue;
        for (int x = 0; x < picture.extent().width; ++x)
          picture(x, y) = Rgb(1.0F + static_cast<float>(x));
      }
      picture(0, 0) = Rgb(1.0F);
    },
    [](Grid<Rgb>& picture, Random& random) {  // a bright row of a pole
      const float sky = integer(random, 0, 1) == 0 ? 0.0F : 1.0F;
      std::ranges::fill(picture.values(), Rgb(sky));
      const int row = integer(random, 0, 1) * (picture.extent().height - 1);
      const float light = std::pow(10.0F, static_cast<float>(integer(random, 0, 6)));
      std::ranges::fill(picture.row(row), Rgb(light));
    },
    [](Grid<Rgb>& picture, Random& /*random*/) {
      std::ranges::fill(picture.values(), Rgb(1.0F, 0.0F, 0.0F));
    }};

// Points are directed at the rows of the poles, however faint: the sampler's own sums, rounded to
// 2^-31, put such a row elsewhere than the exact ones.
TEST(Positions, OfAFaintRowAtThePoleAreAccepted) {
  EnvironmentMap map = {"faint pole", Grid<Rgb>({64, 32}, Rgb(1.0F)), {}};
  std::ranges::fill(map.radiance.row(31), Rgb(1e-5F));
  std::vector<Subject> subjects;
  for (const char* name : {"guide_lines", "linear_scan"}) {
    subjects.push_back(subject_of(sampler_by_name(name), Weighting::B));
  }
  const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1U << 22U});
  for (const TestRecord& test : result.tests) {
    EXPECT_NE(test.outcome, Outcome::reject) << test.sampler << ": " << test.test;
  }
}

// An alias table cannot be asked for the points of a row: what is not tested is said.
TEST(Positions, InARowThatNoPointsCanBeDirectedAtAreRecordedAsNotRun) {
  const EnvironmentMap map = {"even", Grid<Rgb>({128, 64}, Rgb(1.0F)), {}};
  const std::vector<Subject> subjects = {subject_of(sampler_by_name("alias"), Weighting::B),
                                         subject_of(sampler_by_name("guide_lines"), Weighting::B)};
  const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1U << 15U});
  std::size_t found = 0;
  for (const TestRecord& test : result.tests) {
    if (test.test != "positions in the first row" && test.test != "positions in the last row") {
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

class Robustness : public testing::TestWithParam<std::size_t> {};

TEST_P(Robustness, NoSoundSamplerIsRejectedOnSmallMaps) {
  Random random(static_cast<unsigned>(GetParam()));
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  for (int run = 0; run < 8; ++run) {
    // Maps of one row are those whose density changes most inside a texel.
    const int height = run % 4 == 0 ? 1 : integer(random, 1, 35);
    const Extent extent = {integer(random, 0, 1) == 0 ? 2 * height : integer(random, 1, 70),
                           height};
    EnvironmentMap map = {"generated", Grid<Rgb>(extent), {}};
    kPaints[GetParam()](map.radiance, random);
    constexpr std::array<float, 5> kScales = {1.0F, 1e-9F, 1e9F, 1e-33F, 1e24F};
    const float scale = kScales[static_cast<std::size_t>(integer(random, 0, 4))];
    for (Rgb& rgb : map.radiance.values()) rgb *= scale;
    const std::uint64_t samples = std::uint64_t{1}
                                  << static_cast<unsigned>(integer(random, 10, 15));
    const GateResult result = run_gate({&map, 1}, sound, {.samples = samples, .seed = random()});
    for (const TestRecord& test : result.tests) {
      EXPECT_NE(test.outcome, Outcome::reject)
          << test.sampler << " " << test.weighting << " on " << extent.width << "x" << extent.height
          << ", run " << run << ": " << test.oracle << "/" << test.test << ": " << test.detail;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(LampsMirroredSkyRowsPolesColour, Robustness,
                         testing::Range(std::size_t{0}, kPaints.size()));

}  // namespace
}  // namespace lightproof
