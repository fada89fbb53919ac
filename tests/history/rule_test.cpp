#include "lightproof/history/rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using Values = std::vector<double>;

/// The distribution of the time of a process: log-normal; of a busy machine, one process in ten is
/// late by up to a half.
struct TimeDistribution {
  double spread = 0.01;  ///< standard deviation of log time
  bool busy = false;

  friend void PrintTo(const TimeDistribution& distribution, std::ostream* out) {
    *out << distribution.spread << (distribution.busy ? ", busy" : "");
  }
};

Values times(const RandomStream& stream, std::size_t count, double level,
             const TimeDistribution& distribution) {
  Values values;
  for (std::size_t i = 0; i < count; ++i) {
    const SquarePoint u = stream.point(i);
    const double late = distribution.busy && u.t < 0.1 ? 1.0 + 5.0 * u.t : 1.0;
    values.push_back(level * late * std::exp(distribution.spread * normal_quantile(u.s + 0x1p-54)));
  }
  return values;
}

struct Pair {
  Values base;
  Values head;
};

/// 15 runs of both.
Pair pair_of(std::uint64_t number, double ratio, const TimeDistribution& distribution) {
  const RandomStream stream("history/rule", 1);
  return {times(stream.substream(2 * number), 15, 100.0, distribution),
          times(stream.substream(2 * number + 1), 15, 100.0 * ratio, distribution)};
}

/// Of this many pairs, how many the rule finds slower.
int found(double ratio, const TimeDistribution& distribution, std::uint64_t pairs) {
  int count = 0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const auto [base, head] = pair_of(i, ratio, distribution);
    count += judge(Metric::nanoseconds, base, head, {}).change == Change::slower ? 1 : 0;
  }
  return count;
}

class FalseAlarms : public testing::TestWithParam<TimeDistribution> {};

// In one session p is at most .001; the confirmation squares it. Poisson: more than 18 alarms of
// 4000 have a probability of 1e-7 at that rate.
TEST_P(FalseAlarms, AreRarerThanAlpha) { EXPECT_LE(found(1.0, GetParam(), 4000), 18); }

INSTANTIATE_TEST_SUITE_P(Distributions, FalseAlarms,
                         testing::Values(TimeDistribution{0.002}, TimeDistribution{0.01},
                                         TimeDistribution{0.03}, TimeDistribution{0.1},
                                         TimeDistribution{0.01, true}, TimeDistribution{0.1, true}),
                         [](const auto& test) {
                           return "PerMille" +
                                  std::to_string(std::lround(1000.0 * test.param.spread)) +
                                  (test.param.busy ? "Busy" : "");
                         });

// The median of 15 with a spread of 1 % has an error of 0.32 %, the ratio of two 0.46 %: 10 % is
// ten of them beyond the limit of 5 %. With a spread of 3 %, 30 % is fifteen of them beyond it.
TEST(RuleOfTimes, FindsSlowDownsThatClearTheLimit) {
  EXPECT_EQ(found(1.10, {0.01}, 1000), 1000);
  EXPECT_EQ(found(1.30, {0.03}, 1000), 1000);
}

// Late runs of base raise the limit, now and then beyond 10 %. What is found is a property of the
// rule: nine of ten here, and the least that is asked of it four of five.
TEST(RuleOfTimes, FindsMostSlowDownsOnABusyMachine) {
  EXPECT_GE(found(1.10, {0.01, true}, 1000), 800);
  EXPECT_GE(found(1.30, {0.01, true}, 1000), 980);
}

// At the limit itself half of them pass it, whatever the number of runs.
TEST(RuleOfTimes, FindsAboutHalfAtTheLimit) {
  const int at_limit = found(1.05, {0.002}, 1000);
  EXPECT_GT(at_limit, 400);
  EXPECT_LT(at_limit, 600);
}

TEST(RuleOfTimes, FindsNothingBelowTheLimitHoweverCertain) {
  EXPECT_EQ(found(1.04, {0.002}, 1000), 0);
}

// Beyond a spread of 5 % the limit follows the noise.
TEST(RuleOfTimes, LimitGrowsWithTheNoiseOfBase) {
  const RandomStream stream("history/limit", 1);
  const Values quiet = times(stream, 15, 100.0, {0.002});
  const Values loud = times(stream, 15, 100.0, {0.2});
  EXPECT_DOUBLE_EQ(judge(Metric::nanoseconds, quiet, quiet, {}).limit, 1.05);
  const Judgement judgement = judge(Metric::nanoseconds, loud, loud, {});
  EXPECT_DOUBLE_EQ(judgement.limit, std::exp(3.0 * judgement.noise));
  EXPECT_GT(judgement.limit, 1.15);
}

/// The root mean square of the noise that is stated, over that of the logarithm of the ratio of the
/// medians of equal programs.
double stated_over_measured_noise(const TimeDistribution& distribution) {
  double measured = 0.0;
  double stated = 0.0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const auto [base, head] = pair_of(i, 1.0, distribution);
    const Judgement judgement = judge(Metric::nanoseconds, base, head, {});
    measured += std::log(judgement.ratio) * std::log(judgement.ratio);
    stated += judgement.noise * judgement.noise;
  }
  return std::sqrt(stated / measured);
}

// 4000 pairs know a standard deviation to 1.1 %; the rest is Maritz and Jarrett's bias at 15
// values, upwards, and more so with late runs: on the side of fewer alarms.
TEST(RuleOfTimes, NoiseIsWhatComparingBaseWithItselfShows) {
  EXPECT_NEAR(stated_over_measured_noise({0.03}), 1.0, 0.15);
  const double busy = stated_over_measured_noise({0.03, true});
  EXPECT_GE(busy, 1.0);
  EXPECT_LE(busy, 1.5);
}

TEST(RuleOfTimes, FewRunsOfHeadMakeMoreNoise) {
  const Values base = times(RandomStream("history/few", 1), 20, 100.0, {0.05});
  const Values few(base.begin(), base.begin() + 5);
  EXPECT_NEAR(judge(Metric::nanoseconds, base, few, {}).noise /
                  judge(Metric::nanoseconds, base, base, {}).noise,
              std::sqrt(5.0 / 2.0), 1e-12);
}

TEST(RuleOfTimes, SaysWhatIsFaster) {
  const Values base = times(RandomStream("history/faster", 1), 15, 100.0, {0.01});
  Values head = base;
  for (double& value : head) value *= 0.8;
  EXPECT_EQ(judge(Metric::nanoseconds, base, head, {}).change, Change::faster);
  EXPECT_EQ(judge(Metric::nanoseconds, head, base, {}).change, Change::slower);
}

TEST(RuleOfInstructions, IsAHardLimit) {
  const Values base = {1000.0};
  EXPECT_EQ(judge(Metric::instructions, base, Values{1010.0}, {}).change, Change::none);
  EXPECT_EQ(judge(Metric::instructions, base, Values{1011.0}, {}).change, Change::slower);
  EXPECT_EQ(judge(Metric::instructions, base, Values{980.0}, {}).change, Change::faster);
  EXPECT_FALSE(judge(Metric::instructions, base, base, {}).log10_p.has_value());
  EXPECT_EQ(judge(Metric::error, base, Values{1000.0 * (1.0 + 5e-7)}, {}).change, Change::none);
  EXPECT_EQ(judge(Metric::error, base, Values{1000.0 * (1.0 + 2e-6)}, {}).change, Change::slower);
  EXPECT_EQ(judge(Metric::error, base, Values{990.0}, {}).change, Change::faster);
}

// 1 / C(14, 7) = 1/3432 < .001 < 1 / C(12, 6) = 1/924.
TEST(LeastRuns, IsWhereTheSmallestPValueReachesAlpha) {
  EXPECT_EQ(least_runs({}), 7U);
  EXPECT_FALSE(enough_runs(6, 6, {}));
  EXPECT_TRUE(enough_runs(7, 7, {}));
  EXPECT_TRUE(enough_runs(4, 20, {}));
}

}  // namespace
}  // namespace lightproof
