// The published linear scan's failures, as they were measured: triggers, and errors of float sums
// by the length of a row.
#include "lightproof/stability/published_row.h"

#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/samplers/linear_scan_published.h"
#include "lightproof/stability/hard_maps.h"

namespace lightproof {
namespace {

constexpr TargetDensity kTarget = {DensitySpace::texture, kPublishedLuminance};
constexpr Extent kExtent = {64, 32};
/// Of the logarithm of radiances: rows of high dynamic range.
constexpr double kSigma = 2.0;

/// As the listing decodes 8-bit texels, in float.
EnvironmentMap decoded(EnvironmentMap map) {
  for (Rgb& rgb : map.radiance.values()) {
    for (int c = 0; c < 3; ++c) rgb[c] = std::pow(rgb[c], 2.2F);
  }
  return map;
}

EnvironmentMap with_texel(float value) {
  EnvironmentMap map = hard_maps::constant(kExtent);
  map.radiance(20, 10) = Rgb(value);
  return map;
}

std::vector<float> row_of(const EnvironmentMap& map) {
  std::vector<float> weights;
  for (const Rgb& rgb : map.radiance.row(0)) weights.push_back(rgb.r);
  return weights;
}

PublishedRow lognormal_row(int width, std::uint64_t seed) {
  return PublishedRow(row_of(hard_maps::lognormal({width, 1}, kSigma, seed)));
}

/// The same with a sun of 1e7 after a quarter of the row.
PublishedRow row_with_sun(int width, std::uint64_t seed) {
  std::vector<float> weights = row_of(hard_maps::lognormal({width, 1}, kSigma, seed));
  weights[weights.size() / 4] = 1e7F;
  return PublishedRow(std::move(weights));
}

TEST(PublishedRow, IsTheScanOfThePublishedSampler) {
  const EnvironmentMap map = hard_maps::lognormal({100, 1}, 1.0, 3);
  const LinearScanPublished sampler(map, {DensitySpace::texture, {1.0, 0.0, 0.0}});
  const PublishedRow row(row_of(map));
  for (std::uint32_t k = 0; k < (1U << 24U); k += 4099) {
    const TexelSample sample = sampler.sample({k * 0x1p-24, 0.5});
    ASSERT_EQ(row.stop(k).index, sample.x) << k;
    if (sample.x == 100) continue;  // off the end
    ASSERT_EQ(static_cast<double>(row.position(k)), sample.at.s) << k;
  }
}

/// Whether every sample of a grid of points leaves the map below or beside it, at no number.
bool is_lost_everywhere(const EnvironmentMap& map) {
  const LinearScanPublished sampler = LinearScanPublished::as_listed(map, kTarget);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      const TexelSample sample = sampler.sample({(i + 0.3) / 8, (j + 0.3) / 8});
      if (sample.y != kExtent.height || !std::isnan(sample.at.t)) return false;
    }
  }
  return true;
}

TEST(PublishedScan, RunsOffABlackMapAtEveryPoint) {
  EXPECT_TRUE(is_lost_everywhere(hard_maps::constant(kExtent, 0.0F)));
  EXPECT_FALSE(is_lost_everywhere(hard_maps::constant(kExtent)));
}

TEST(PublishedScan, RunsOffAMapWithOneTexelThatIsNotFiniteAtEveryPoint) {
  EXPECT_TRUE(is_lost_everywhere(decoded(with_texel(std::nanf("")))));
  EXPECT_TRUE(is_lost_everywhere(decoded(with_texel(HUGE_VALF))));
}

TEST(PublishedScan, RunsOffAMapWithOneTexelThatItsDecodingMakesSo) {
  EXPECT_TRUE(is_lost_everywhere(decoded(with_texel(-1e-3F)))) << "pow of a negative number";
  EXPECT_TRUE(is_lost_everywhere(decoded(with_texel(1e18F)))) << "1e18^2.2 is beyond floats";
}

TEST(PublishedScan, IsSilentlyWrongBesideANegativeTexel) {
  EnvironmentMap map = hard_maps::constant({8, 4});
  map.radiance(5, 2) = Rgb(-20.0F);
  const LinearScanPublished sampler = LinearScanPublished::as_listed(map, kTarget);
  const PublishedRow row({1, 1, 1, 1, 1, -20, 1, 1});
  EXPECT_FALSE(std::is_sorted(row.sums().begin(), row.sums().end())) << "the CDF falls";
  // Finite, on the map, of positive density: nothing tells that row 2 is never drawn.
  for (int j = 0; j < 64; ++j) {
    const TexelSample sample = sampler.sample({0.4, (j + 0.5) / 64});
    EXPECT_NE(sample.y, 2);
  }
}

#if defined(__SSE2__)
TEST(PublishedScan, TakesADenormalMapForBlackWhereThoseAreFlushed) {
  EXPECT_FALSE(is_lost_everywhere(hard_maps::constant(kExtent, 1e-39F)));
  const unsigned before = _mm_getcsr();
  constexpr unsigned kFlushed = 0x8040;  // results and operands
  _mm_setcsr(before | kFlushed);
  const bool lost = is_lost_everywhere(hard_maps::constant(kExtent, 1e-39F));
  _mm_setcsr(before);
  EXPECT_TRUE(lost);
}
#endif

TEST(PublishedScan, GivesTheCoordinateOneAtOne) {
  const EnvironmentMap map = hard_maps::constant(kExtent);
  const TexelSample sample = LinearScanPublished(map, kTarget).sample({1.0, 0.5});
  EXPECT_EQ(sample.at.s, 1.0);
  EXPECT_EQ(static_cast<int>(sample.at.s * kExtent.width), kExtent.width) << "the texel beyond";
}

/// What became of many rows of one width.
struct Rows {
  int count = 0;
  int short_of_one = 0;    ///< whose last sum is below the largest random number
  double falls_off = 0.0;  ///< mean probability
  double worst_fall = 0.0;
};

Rows many_rows(int width, int count) {
  Rows rows{.count = count};
  for (int seed = 0; seed < count; ++seed) {
    const PublishedRow row = lognormal_row(width, static_cast<std::uint64_t>(seed));
    rows.short_of_one += row.misses_last_number() ? 1 : 0;
    rows.falls_off += row.falls_off() / count;
    rows.worst_fall = std::max(rows.worst_fall, row.falls_off());
  }
  return rows;
}

TEST(PublishedScan, FallsOffTheEndOfAThirdToHalfOfAllRows) {
  // Measured: 31 to 53 % of scans, on average with a probability of 1e-7 (256) to 7e-7 (8192), at
  // most 6e-6.
  constexpr int kRows = 400;
  for (const int width : {256, 1024, 4096, 8192}) {
    const Rows rows = many_rows(width, kRows);
    const double share = static_cast<double>(rows.short_of_one) / kRows;
    const double error = std::sqrt(0.25 / kRows);
    EXPECT_GT(share, 0.31 - 4.0 * error) << width;
    EXPECT_LT(share, 0.53 + 4.0 * error) << width;
    EXPECT_GT(rows.falls_off, 0.5e-7) << width;
    EXPECT_LT(rows.falls_off, 1.4e-6) << width;
    EXPECT_LT(rows.worst_fall, 1.2e-5) << width;
  }
}

struct ByLength {
  int width;
  double error;  ///< largest of a sum, as measured
  double error_with_sun;
  double misplaced;  ///< share of samples, as measured
  double misplaced_with_sun;
};

class PublishedRowsByLength : public testing::TestWithParam<ByLength> {};

/// The largest error of a sum, and the mean share of misplaced samples, of 25 rows.
struct RowErrors {
  double largest = 0.0;
  double misplaced = 0.0;
};

RowErrors errors_of(PublishedRow (*row_of_seed)(int width, std::uint64_t seed), int width) {
  constexpr std::uint64_t kRows = 25;
  RowErrors errors;
  for (std::uint64_t seed = 0; seed < kRows; ++seed) {
    const PublishedRow row = row_of_seed(width, seed);
    errors.largest = std::max(errors.largest, row.largest_error());
    errors.misplaced += row.misplaced() / kRows;
  }
  return errors;
}

/// Errors of sums are random walks: the largest one of 25 scatters by about half of itself, and so
/// does what it was measured to be.
TEST_P(PublishedRowsByLength, ErrAsMeasured) {
  const ByLength& measured = GetParam();
  const RowErrors plain = errors_of(lognormal_row, measured.width);
  const RowErrors sunny = errors_of(row_with_sun, measured.width);
  constexpr double kScatter = 2.0;
  EXPECT_GT(plain.largest, measured.error / kScatter);
  EXPECT_LT(plain.largest, measured.error * kScatter);
  EXPECT_GT(sunny.largest, measured.error_with_sun / kScatter);
  EXPECT_LT(sunny.largest, measured.error_with_sun * kScatter);
  EXPECT_GT(plain.misplaced, measured.misplaced / kScatter);
  EXPECT_LT(plain.misplaced, measured.misplaced * kScatter);
  EXPECT_GT(sunny.misplaced, measured.misplaced_with_sun / kScatter);
  EXPECT_LT(sunny.misplaced, measured.misplaced_with_sun * kScatter);
}

INSTANTIATE_TEST_SUITE_P(Widths, PublishedRowsByLength,
                         testing::Values(ByLength{1024, 1.5e-6, 4.0e-6, 0.0003, 0.0004},
                                         ByLength{4096, 3.2e-6, 8.8e-6, 0.0020, 0.0031},
                                         ByLength{8192, 4.5e-6, 1.9e-5, 0.0060, 0.0061},
                                         ByLength{16384, 6.7e-6, 3.4e-5, 0.015, 0.012}));

TEST(PublishedRow, LandsInTheNeighbourMoreOftenTheLongerTheRow) {
  // Measured: 2e-5 (512), 2e-4 (4k), 4e-4 (8k), 8e-4 (16k).
  struct Measured {
    int width;
    double share;
  };
  for (const auto [width, share] :
       {Measured{512, 2e-5}, Measured{4096, 2e-4}, Measured{8192, 4e-4}, Measured{16384, 8e-4}}) {
    const double found = lognormal_row(width, 1).lands_in_neighbour();
    EXPECT_GT(found, share / 1.5) << width;
    EXPECT_LT(found, share * 1.5) << width;
  }
}

TEST(PublishedRow, AbsorbsTheSkyBesideASun) {
  // Measured, of 8192 columns, a sun in column 100 over a sky of 1: how many are reached by numbers
  // of 24 bits, those of (0,1].
  struct Measured {
    float sun;
    int reached;
  };
  for (const auto [sun, reached] : {Measured{1e7F, 6883}, Measured{1e8F, 17}, Measured{1e9F, 2}}) {
    std::vector<float> weights(8192, 1.0F);
    weights[100] = sun;
    EXPECT_EQ(PublishedRow(weights).reachable(1, 1U << 24U), reached) << sun;
  }
}

TEST(PublishedFlatSum, NeverReachesMostOfALargeConstantMap) {
  EXPECT_EQ(unreachable_by_flat_sum(1024), 0.0);
  EXPECT_EQ(unreachable_by_flat_sum(4096), 0.0);
  EXPECT_NEAR(unreachable_by_flat_sum(8192), 0.5, 1e-6);
  EXPECT_NEAR(unreachable_by_flat_sum(16384), 0.875, 1e-6);
}

}  // namespace
}  // namespace lightproof
