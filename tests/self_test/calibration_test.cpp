// p-values of a sampler that is right are uniform, and whole runs reject it as rarely as promised.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "lightproof/self_test/calibration.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

constexpr double kAlpha = 1e-6;

/// P-values for each test. Of 10,000 those show whose distribution is off by 0.027 anywhere, of the
/// quick form's 2,500 those off by 0.054 (Kolmogorov's bound at kAlpha).
std::uint64_t replicates() {
  return test::is_thorough() ? CalibrationOptions{}.replicates : std::uint64_t{2500};
}

/// One calibration for all tests of this file.
const CalibrationResult& calibration() {
  static const CalibrationResult result = calibrate({.replicates = replicates()});
  return result;
}

/// P(at most `count` of `trials`) and P(at least) at this rate.
double at_most(std::uint64_t count, std::uint64_t trials, double rate) {
  const boost::math::binomial distribution(static_cast<double>(trials), rate);
  return boost::math::cdf(distribution, static_cast<double>(count));
}
double at_least(std::uint64_t count, std::uint64_t trials, double rate) {
  const boost::math::binomial distribution(static_cast<double>(trials), rate);
  return count == 0 ? 1.0
                    : boost::math::cdf(
                          boost::math::complement(distribution, static_cast<double>(count - 1)));
}

TEST(Calibration, CoversEveryTestThatHasAPValue) {
  EXPECT_EQ(calibration().tests.size(), 30U);
  for (const CalibrationRecord& record : calibration().tests) {
    EXPECT_EQ(record.replicates, replicates()) << full_name(record.test);
  }
}

TEST(Calibration, PValuesAreUniform) {
  for (const CalibrationRecord& record : calibration().tests) {
    EXPECT_GT(record.log10_p_ks, std::log10(kAlpha))
        << full_name(record.test) << ", D = " << record.ks_distance;
    if (record.log10_p_anderson) {
      EXPECT_GT(*record.log10_p_anderson, std::log10(kAlpha)) << full_name(record.test);
    }
  }
}

TEST(Calibration, OneInAHundredIsBelowOnePercent) {
  for (const CalibrationRecord& record : calibration().tests) {
    EXPECT_GT(at_least(record.below_one_percent, record.replicates, 0.01), kAlpha)
        << full_name(record.test) << ": " << record.below_one_percent;
    if (record.is_bound) continue;
    EXPECT_GT(at_most(record.below_one_percent, record.replicates, 0.01), kAlpha)
        << full_name(record.test) << ": " << record.below_one_percent;
  }
}

TEST(Calibration, RunsAreWrongAsRarelyAsTheyPromise) {
  ASSERT_EQ(calibration().families.size(), 3U);
  for (const FamilyRecord& family : calibration().families) {
    EXPECT_GE(family.runs, 1000U);
    EXPECT_EQ(family.family_alpha, 0.05);
    EXPECT_GT(at_least(family.rejected, family.runs, family.family_alpha), kAlpha)
        << family.procedure << ": " << family.rejected << " of " << family.runs;
  }
  // And not far below its bound, although tests depend on each other: above a fifth of it, with an
  // error probability of one in a hundred.
  for (const FamilyRecord& family : calibration().families) {
    if (family.is_bound) continue;
    EXPECT_LT(at_least(family.rejected, family.runs, 0.2 * family.family_alpha), 0.01)
        << family.procedure << ": " << family.rejected << " of " << family.runs;
  }
}

}  // namespace
}  // namespace lightproof
