#include "lightproof/samplers/cdf_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

Grid<double> row_of(const std::vector<double>& weights) {
  Grid<double> grid({static_cast<int>(weights.size()), 1});
  std::copy(weights.begin(), weights.end(), grid.values().begin());
  return grid;
}

TEST(CdfLines, RunsOfSimilarTexelsTakeTwoBytesEach) {
  std::vector<double> weights;
  for (int i = 0; i < 96; ++i) weights.push_back(1.0 + 0.5 * std::sin(i));
  const CdfLines lines(row_of(weights));
  EXPECT_EQ(lines.extent(), (Extent{3, 1}));
  EXPECT_EQ(lines.wide_count(), 0U);
  constexpr std::size_t kBefore = 64 + 128;  // a run of each form before the first
  EXPECT_EQ(lines.bytes(), 96U * 2U + kBefore);
}

TEST(CdfLines, RunsOfAnyContrastKeepTheirMasses) {
  std::vector<double> weights;
  for (int i = 0; i < 70; ++i) weights.push_back(std::pow(10.0, -(i % 7)));
  weights[40] = 0.0;
  const CdfLines lines(row_of(weights));
  EXPECT_EQ(lines.wide_count(), 3U);
  const Grid<double> sums = run_weights(row_of(weights));
  for (int x = 0; x < 70; ++x) {
    const double share = weights[static_cast<std::size_t>(x)] / sums(x / kRunTexels, 0);
    const double mass = lines.mass(static_cast<std::size_t>(x / kRunTexels), x % kRunTexels);
    EXPECT_NEAR(mass, share, share / 32.0) << x;
    EXPECT_EQ(mass > 0.0, share > 0.0) << x;
  }
}

TEST(CdfLines, EveryTexelWithLightIsFoundFromEndToEnd) {
  const std::vector<std::vector<double>> cases = {
      {1.0},
      {0.0, 0.0, 1.0, 0.0},
      std::vector<double>(32, 1.0),
      std::vector<double>(33, 1.0),
      {0.0, 1e-9, 1.0, 0.0, 1e6, 1e-3},
  };
  for (const std::vector<double>& weights : cases) {
    const CdfLines lines(row_of(weights));
    for (std::size_t run = 0; run < lines.extent().count(); ++run) {
      double below = 0.0;
      for (int i = 0; i < kRunTexels; ++i) {
        const std::size_t x = run * kRunTexels + static_cast<std::size_t>(i);
        const double mass = lines.mass(run, i);
        ASSERT_EQ(mass > 0.0, x < weights.size() && weights[x] > 0.0) << x;
        if (!(mass > 0.0)) continue;
        for (const double fraction : {1e-6, 0.5, 1.0 - 1e-6}) {
          const RunTexel found = lines.find(run, below + fraction * mass);
          ASSERT_EQ(found.index, i);
          ASSERT_EQ(found.mass, mass);
          ASSERT_NEAR(found.fraction, fraction, 1e-9 / mass);
        }
        below += mass;
      }
      ASSERT_NEAR(below, 1.0, 1e-15);
      // The ends: the first and the last texel with light.
      EXPECT_GT(lines.find(run, 0.0).mass, 0.0);
      EXPECT_LT(lines.find(run, 1.0 - 0x1p-53).fraction, 1.0);
      EXPECT_GT(lines.find(run, 1.0 - 0x1p-53).mass, 0.0);
    }
  }
}

}  // namespace
}  // namespace lightproof
