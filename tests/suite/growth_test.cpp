#include "lightproof/suite/growth.h"

#include <gtest/gtest.h>

#include <cmath>

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
    EXPECT_FALSE(fit.knees) << fit.sampler;
    ASSERT_TRUE(fit.build_exponent);
    EXPECT_NEAR(fit.build_exponent->value, 0.9, 1e-12);
    EXPECT_NEAR(fit.build_exponent->error, 0.0, 1e-12);
  }
}

TEST(Growth, HasAKneeWhereStepsSlowDown) {
  std::vector<ThroughputRecord> records;
  for (const int width : {8192, 256, 4096, 512, 2048, 1024}) {  // the order does not matter
    records.push_back(record("alias", width, 5.0 * std::pow(std::max(1.0, width / 1024.0), 0.5)));
  }
  const auto fits = growth_of(records, {});
  ASSERT_EQ(fits.size(), 1U);
  ASSERT_TRUE(fits[0].knees);
  EXPECT_NEAR(fits[0].knees->exponent_before, 0.0, 1e-12);
  ASSERT_EQ(fits[0].knees->knees.size(), 1U);
  EXPECT_EQ(fits[0].knees->knees[0].extent, (Extent{1024, 512}));
  EXPECT_NEAR(fits[0].knees->knees[0].exponent_after, 0.5, 1e-12);
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
