// The gate sees what it says that it would see.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cstdio>
#include <set>
#include <string>

#include "lightproof/self_test/power.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

TEST(Power, IsThePredictedOne) {
  constexpr double kAlpha = 1e-6;
  std::set<TestId> telling;
  for (const PowerRecord& record : measure_power({})) {
    const boost::math::binomial distribution(static_cast<double>(record.replicates),
                                             record.predicted);
    const auto count = static_cast<double>(record.rejected);
    const std::string what = full_name(record.test) + ", N = " + std::to_string(record.samples) +
                             ": " + std::to_string(record.rejected) + ", predicted " +
                             std::to_string(record.predicted);
    EXPECT_GT(boost::math::cdf(distribution, count), kAlpha) << what;
    if (record.predicted > 0.2 && record.predicted < 0.99) telling.insert(record.test);
    if (record.is_bound || record.rejected == 0) continue;
    EXPECT_GT(boost::math::cdf(boost::math::complement(distribution, count - 1.0)), kAlpha) << what;
  }
  EXPECT_EQ(telling.size(), 6U) << "every test is tried where its power is neither 0 nor 1";
}

// An effect as large as the gate prints beside an acceptance is found in 99 of 100 runs. Of 100
// runs 9 misses reject that at 1e-6, of the quick form's 20 runs 6.
TEST(Power, OfTheGateForWhatItSaysThatItDetects) {
  const std::vector<PowerRecord> records =
      measure_printed_effects({.replicates = test::is_thorough() ? 100U : 20U});
  std::set<TestId> covered;
  for (const PowerRecord& record : records) covered.insert(record.test);
  const std::vector<TestId> printed = printed_effects();
  EXPECT_EQ(covered, std::set<TestId>(printed.begin(), printed.end()));
  for (const PowerRecord& record : records) {
    const boost::math::binomial distribution(static_cast<double>(record.replicates),
                                             record.predicted);
    EXPECT_GT(boost::math::cdf(distribution, static_cast<double>(record.rejected)), 1e-6)
        << full_name(record.test) << ", effect " << record.effect << ": " << record.rejected
        << " of " << record.replicates;
    std::printf("%s: effect %.4g found in %llu of %llu runs\n", full_name(record.test).c_str(),
                record.effect, static_cast<unsigned long long>(record.rejected),
                static_cast<unsigned long long>(record.replicates));
  }
}

}  // namespace
}  // namespace lightproof
