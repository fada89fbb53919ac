// The published sampler's edge behaviour, kept as it was printed.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/samplers/linear_scan_published.h"
#include "reference/slow_sampler.h"

namespace lightproof {
namespace {

constexpr TargetDensity kTarget = {DensitySpace::texture, kPublishedLuminance};

TEST(LinearScanPublished, BlackFirstRowAtZeroLeavesTheMap) {
  const EnvironmentMap map = make_synthetic_map("black-first-row", {64, 32});
  const TexelSample sample = LinearScanPublished(map, kTarget).sample({0.5, 0.0});
  EXPECT_EQ(sample.y, 0);
  EXPECT_EQ(sample.x, 64) << "0/0 probabilities never reach the random number";
  EXPECT_TRUE(std::isnan(sample.at.t));
  EXPECT_EQ(sample.pdf.value, 0.0);
}

TEST(LinearScanPublished, BlackFirstColumnAtZeroIsNotANumber) {
  EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  for (int y = 0; y < 32; ++y) map.radiance(0, y) = Rgb(0.0F);
  const TexelSample sample = LinearScanPublished(map, kTarget).sample({0.0, 0.5});
  EXPECT_EQ(sample.x, 0);
  EXPECT_TRUE(std::isnan(sample.at.s));
}

TEST(LinearScanPublished, SumsThatRoundBelowOneRunOffTheEnd) {
  // 1/width of a width that is no power of two is rounded down; so is the sum of many.
  int ran_off = 0;
  for (int width = 3; width < 400; ++width) {
    const EnvironmentMap map = make_synthetic_map("constant", {width, 2});
    ran_off += LinearScanPublished(map, kTarget).sample({1.0 - 0x1p-24, 0.5}).x == width ? 1 : 0;
  }
  EXPECT_GT(ran_off, 0);
}

/// Whether two samples are one, bit for bit.
bool is_same(const TexelSample& a, const TexelSample& b) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(std::array{a.at.s, a.at.t, a.pdf.value}) ==
             std::bit_cast<std::array<std::uint64_t, 3>>(std::array{b.at.s, b.at.t, b.pdf.value}) &&
         a.x == b.x && a.y == b.y;
}

// Ordinary numbers, and those at which a scan stops early, runs off the end, or sums what is none.
TEST(CachedScan, DrawsWhatTheScanDrawsBitForBit) {
  std::vector<double> numbers = {0.0, 0x1p-24, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53};
  for (int i = 0; i < 200; ++i) numbers.push_back(std::fmod(0.618 * i, 1.0));
  const Rgb not_a_number(std::numeric_limits<float>::quiet_NaN());
  for (const char* name : {"sun-sky", "gradient", "constant", "black-first-row", "checker"}) {
    for (const bool is_spoilt : {false, true}) {
      EnvironmentMap map = make_synthetic_map(name, {61, 29});
      if (is_spoilt) map.radiance(7, 11) = not_a_number;
      if (is_spoilt) map.radiance(40, 20) = Rgb(-0.5F);
      for (const DensityInfo& density : kDensities) {
        const TargetDensity target = {density.density_space, kPublishedLuminance};
        const LinearScanPublished scan = LinearScanPublished::as_listed(map, target);
        const CachedScan cached(scan);
        for (const double s : numbers) {
          for (const double t : numbers) {
            ASSERT_TRUE(is_same(cached.sample({s, t}), scan.sample({s, t})))
                << name << ", u = (" << s << ", " << t << ")";
          }
        }
      }
    }
  }
}

// Where sums fall once, no search finds where the scan stops; where texels of a row differ in solid
// angle, each is weighed by its own.
TEST(CachedScan, DrawsWhatTheScanDrawsOfFallingSumsAndOfAnOctahedralMap) {
  EnvironmentMap falling = make_synthetic_map("constant", {16, 8});
  falling.radiance(8, 3) = Rgb(-3.0F);  // where bisection looks first
  EnvironmentMap octahedral = make_synthetic_map("gradient", {16, 16});
  octahedral.mapping.kind = MappingKind::octahedral;
  for (const EnvironmentMap& map : {falling, octahedral}) {
    const LinearScanPublished scan =
        LinearScanPublished::as_listed(map, {DensitySpace::solid_angle, kPublishedLuminance});
    const CachedScan cached(scan);
    std::vector<int> differ(64);
    parallel_for(differ.size(), [&](std::size_t i) {
      for (std::size_t j = 0; j < 64; ++j) {
        const SquarePoint u = {(static_cast<double>(j) + 0.3) / 64.0,
                               (static_cast<double>(i) + 0.3) / 64.0};
        differ[i] += is_same(cached.sample(u), scan.sample(u)) ? 0 : 1;
      }
    });
    EXPECT_EQ(std::accumulate(differ.begin(), differ.end(), 0), 0);
  }
}

TEST(LinearScanPublished, AwayFromTheEdgesItIsTheExactSampler) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  const LinearScanPublished published(map, kTarget);
  const BinarySearch exact(map, kTarget);
  const reference::SlowSampler obvious(map, kTarget);
  // Float sums of n terms are off by at most n/2 ulp of 2^-24.
  const double tolerance = (64.0 + 32.0) * 0x1p-24;
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      const SquarePoint u = {(i + 0.31) / 100.0, (j + 0.31) / 100.0};
      if (obvious.near_entry(u, tolerance)) continue;
      ++compared;
      const TexelSample a = published.sample(u);
      const TexelSample b = exact.sample(u);
      ASSERT_TRUE(a.x == b.x && a.y == b.y) << "u = (" << u.s << ", " << u.t << ")";
      EXPECT_NEAR(a.at.s, b.at.s, 64.0 * 0x1p-24);
      EXPECT_NEAR(a.at.t, b.at.t, 32.0 * 0x1p-24);
      EXPECT_NEAR(a.pdf.value / b.pdf.value, 1.0, 64.0 * 0x1p-24);
    }
  }
  EXPECT_GT(compared, 9000);
}

}  // namespace
}  // namespace lightproof
