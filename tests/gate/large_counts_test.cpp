// Counts beyond 32 bits: a run of 1e10 samples is one of the usual size, many times over.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "lightproof/gate/direction_histogram.h"
#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/gate/draws.h"
#include "lightproof/image/synthetic.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr TargetDensity kTarget = {DensitySpace::solid_angle, kRec709};
constexpr std::uint64_t kSamples = 1U << 12U;
constexpr int kDoublings = 23;
constexpr std::uint64_t kTimes = std::uint64_t{1} << kDoublings;
static_assert(kTimes * kSamples > 10'000'000'000U);

template <class Counts>
std::uint64_t sum_of(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Whether all of these are the others so many times over.
bool is_multiple(std::span<const std::uint64_t> large, std::span<const std::uint64_t> small) {
  return std::ranges::equal(
      large, small, [](std::uint64_t all, std::uint64_t once) { return all == kTimes * once; });
}

TEST(LargeCounts, OfTenBillionSamplesAreExact) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {8, 4});
  const auto sampler =
      bound(DiscreteSampler(reference::texel_masses(map, kTarget), kTarget.density_space));
  const Draws once = draw_samples(sampler, expectation_of(map, kTarget),
                                  RandomStream("large counts", 1), {0, kSamples});
  Draws all = once;
  for (int doubling = 0; doubling < kDoublings; ++doubling) all.merge(Draws(all));

  EXPECT_EQ(all.samples, kTimes * kSamples);
  EXPECT_TRUE(is_multiple(all.bins.values(), once.bins.values()));
  EXPECT_EQ(sum_of(all.bins.values()), kTimes * kSamples);
  EXPECT_TRUE(is_multiple(all.texels.values(), once.texels.values()));
  EXPECT_TRUE(is_multiple(all.pairs.values(), once.pairs.values()));
  EXPECT_TRUE(is_multiple(all.positions.values(), once.positions.values()));
  EXPECT_TRUE(is_multiple(all.marginal, once.marginal));
  EXPECT_TRUE(is_multiple(all.column_marginal, once.column_marginal));
  EXPECT_EQ(sum_of(row_counts(all.texels)), kTimes * kSamples);
  EXPECT_EQ(sum_of(column_counts(all.texels)), kTimes * kSamples);
  for (std::size_t lag = 0; lag < kLags.size(); ++lag) {
    EXPECT_EQ(all.successive.pairs(lag).total, kTimes * once.successive.pairs(lag).total);
  }
  for (const std::size_t coordinate : {0U, 1U}) {
    EXPECT_EQ(sum_of(all.successive.runs(coordinate)),
              kTimes * sum_of(once.successive.runs(coordinate)));
  }
  for (std::size_t i = 0; i < once.estimators.size(); ++i) {
    EXPECT_EQ(all.estimators[i].count(), kTimes * once.estimators[i].count());
    // Of equal halves the mean is that of either: every doubling adds half their difference, 0.
    EXPECT_EQ(all.estimators[i].mean(), once.estimators[i].mean());
  }
}

// The upper half of a sample's number is part of the generator's counter: behind 2^32 samples come
// others, and not the first ones again.
TEST(LargeCounts, BehindFourBillionSamplesComeOthers) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {8, 4});
  const auto sampler =
      bound(DiscreteSampler(reference::texel_masses(map, kTarget), kTarget.density_space));
  const Expectation expectation = expectation_of(map, kTarget);
  const RandomStream stream("large counts", 1);
  const auto mean_at = [&](std::uint64_t first) {
    return draw_samples(sampler, expectation, stream, {first, kSamples}).estimators[0].mean();
  };
  EXPECT_EQ(mean_at(0), mean_at(0));
  EXPECT_NE(mean_at(0), mean_at(std::uint64_t{1} << 32U));
  EXPECT_NE(mean_at(0), mean_at(std::uint64_t{1} << 33U));
}

TEST(LargeCounts, OfDirectionsAreExact) {
  const double x = 0.6;
  const double y = 0.0;
  const double z = 0.8;
  const std::vector<double> xs(1024, x);
  const std::vector<double> ys(1024, y);
  const std::vector<double> zs(1024, z);
  DirectionHistogram all;
  all.add({xs, ys, zs});
  for (int doubling = 0; doubling < 24; ++doubling) all.merge(DirectionHistogram(all));
  EXPECT_EQ(all.samples(), std::uint64_t{1024} << 24U);
  EXPECT_EQ(sum_of(all.bins().values()), std::uint64_t{1024} << 24U);
}

}  // namespace
}  // namespace lightproof
