#include "lightproof/study/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/random.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

constexpr double kMebibyte = 1048576.0;

ThroughputRecord record(std::string_view sampler, int width, double ns) {
  ThroughputRecord r;
  r.sampler = sampler;
  r.map = "sun-sky";
  r.extent = {width, width / 2};
  r.ns_per_sample = ns;
  r.table_bytes = 4.0 * static_cast<double>(r.extent.count());
  r.build_ms = 1e-4 * std::pow(static_cast<double>(r.extent.count()), 0.9);
  return r;
}

const std::vector<int> kWidths = {256, 512, 1024, 2048, 4096, 8192};

TEST(Growth, ExponentsOfALineAndALogarithm) {
  std::vector<ThroughputRecord> records;
  for (const int width : kWidths) {
    records.push_back(record("linear_scan", width, 0.3 * 1.5 * width));
    records.push_back(record("binary_search", width, 5.0 * (2.0 * std::log2(width) - 1.0)));
  }
  const auto fits = growth_of(records, {});
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_NEAR(fits[0].exponent, 1.0, 1e-12);
  for (const StepTime& step : fits[0].steps) EXPECT_NEAR(step.ns, 0.3, 1e-12);
  EXPECT_LT(fits[1].exponent, 0.2);
  EXPECT_GT(fits[1].exponent, 0.0);
  ASSERT_EQ(fits[1].steps.size(), 6U);
  for (const StepTime& step : fits[1].steps) EXPECT_NEAR(step.ns, 5.0, 1e-12);
  for (const GrowthFit& fit : fits) {
    EXPECT_FALSE(fit.segmented) << fit.sampler;
    ASSERT_TRUE(fit.build_exponent);
    EXPECT_NEAR(fit.build_exponent->value, 0.9, 1e-12);
    EXPECT_NEAR(fit.build_exponent->error, 0.0, 1e-12);
  }
}

TEST(Growth, HasABreakpointWhereStepsSlowDown) {
  std::vector<ThroughputRecord> records;
  for (const int width : {8192, 256, 4096, 512, 2048, 1024}) {  // the order does not matter
    records.push_back(record("alias", width, 5.0 * std::pow(std::max(1.0, width / 1024.0), 0.5)));
  }
  const auto fits = growth_of(records, {});
  ASSERT_EQ(fits.size(), 1U);
  ASSERT_TRUE(fits[0].segmented);
  EXPECT_NEAR(fits[0].segmented->exponent_before, 0.0, 1e-12);
  ASSERT_EQ(fits[0].segmented->breakpoints.size(), 1U);
  EXPECT_EQ(fits[0].segmented->breakpoints[0].extent, (Extent{1024, 512}));
  EXPECT_NEAR(fits[0].segmented->breakpoints[0].exponent_after, 0.5, 1e-12);
}

/// All samplers, whose times are a power of the width but for normal scatter.
std::vector<ThroughputRecord> power_laws(std::uint64_t page) {
  const RandomStream stream("suite/growth", 1, page);
  std::vector<ThroughputRecord> records;
  std::uint64_t number = 0;
  for (const SamplerInfo& sampler : samplers()) {
    for (const int width : {256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192}) {
      const double error = normal_quantile(stream.point(number++).s + 0x1p-54);
      records.push_back(record(sampler.name, width, std::pow(width, 0.2) * std::exp(0.05 * error)));
    }
  }
  return records;
}

// With one probability for each sampler, one page in ten would show some.
TEST(Growth, HasBreakpointsByChanceOnOnePageInAHundred) {
  constexpr int kPages = 200;
  int pages = 0;
  for (std::uint64_t page = 0; page < kPages; ++page) {
    const auto fits = growth_of(power_laws(page), {});
    ASSERT_EQ(fits.size(), samplers().size());
    pages +=
        std::ranges::any_of(fits, [](const GrowthFit& fit) { return fit.segmented.has_value(); });
  }
  // More than twelve of a mean of two have a probability below 1e-6.
  EXPECT_LE(pages, 12);
}

TEST(Growth, SaysWhichMapIsTheFirstWhoseTableDoesNotFit) {
  std::vector<ThroughputRecord> records;
  for (const int width : kWidths) records.push_back(record("alias", width, 5.0));
  const GrowthFit known = growth_of(records, {kMebibyte, 512.0 * kMebibyte})[0];
  EXPECT_EQ(known.leaves_l2, (Extent{1024, 512})) << "2 MiB, after half of one";
  EXPECT_EQ(known.leaves_l3, std::nullopt) << "all fit";
  EXPECT_EQ(growth_of(records, {})[0].leaves_l2, std::nullopt) << "not known";
}

TEST(Growth, NeedsThreeMapsAndTimesToBuild) {
  std::vector<ThroughputRecord> records = {record("alias", 256, 5.0), record("alias", 512, 5.0)};
  EXPECT_TRUE(growth_of(records, {}).empty());
  records.push_back(record("alias", 1024, 5.0));
  records.back().build_ms = 0.0;
  const auto fits = growth_of(records, {});
  ASSERT_EQ(fits.size(), 1U);
  EXPECT_FALSE(fits[0].build_exponent);
}

}  // namespace
}  // namespace lightproof
