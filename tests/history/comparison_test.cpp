#include "lightproof/history/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/core/error.h"
#include "synthetic_runs.h"

namespace lightproof {
namespace {

using test::synthetic_run;
using test::synthetic_session;
using test::operator+;
using testing::AllOf;
using testing::HasSubstr;

/// The verdict on the one benchmark of these runs.
RowVerdict verdict_on(const std::vector<BenchmarkRun>& runs) {
  const Comparison comparison = compare(runs, "base", "head");
  EXPECT_EQ(comparison.rows.size(), 1U);
  return comparison.rows.at(0).verdict;
}

std::string refusal_of(const std::vector<BenchmarkRun>& runs, const std::string& base = "base",
                       const std::string& head = "head") {
  try {
    compare(runs, base, head);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::vector<BenchmarkRun> kSlow =
    synthetic_session({.name = "slow", .ratio = 1.2, .seed = 1});
const std::vector<BenchmarkRun> kSlowAgain =
    synthetic_session({.name = "again", .started = 1000, .ratio = 1.2, .seed = 2});
const std::vector<BenchmarkRun> kSame =
    synthetic_session({.name = "same", .started = 1000, .ratio = 1.0, .seed = 3});

TEST(Compare, NeedsTwoSessionsToCallItRegressed) {
  EXPECT_EQ(verdict_on(kSlow), RowVerdict::suspected);
  EXPECT_EQ(verdict_on(kSlow + kSlowAgain), RowVerdict::regressed);
  EXPECT_EQ(verdict_on(kSlow + kSame), RowVerdict::unconfirmed);
  EXPECT_EQ(verdict_on(kSame), RowVerdict::same);
}

TEST(Compare, LooksAtTheTwoLatestSessions) {
  const auto latest =
      synthetic_session({.name = "latest", .started = 2000, .ratio = 1.2, .seed = 4});
  EXPECT_EQ(verdict_on(kSlow + kSame + latest), RowVerdict::suspected);
  EXPECT_EQ(verdict_on(kSame + kSlow + latest), RowVerdict::suspected) << "by time, not by place";
}

TEST(Compare, SaysWhatIsFasterAndOnlyThere) {
  EXPECT_EQ(verdict_on(synthetic_session({.ratio = 0.8})), RowVerdict::faster);
  auto runs = kSame;
  runs.push_back(synthetic_run("head", "same", 1000, {{"new", Metric::nanoseconds, 0, 1.0}}));
  runs.push_back(synthetic_run("base", "same", 1001, {{"old", Metric::instructions, 0, 1.0}}));
  const Comparison comparison = compare(runs, "base", "head");
  ASSERT_EQ(comparison.rows.size(), 3U);
  EXPECT_EQ(count_of(comparison, RowVerdict::only_in_head), 1U);
  EXPECT_EQ(count_of(comparison, RowVerdict::only_in_base), 1U);
}

TEST(Compare, TakesInstructionsAtTheirWord) {
  const auto counts = [](double base, double head) {
    return std::vector<BenchmarkRun>{
        synthetic_run("base", "s", 0, {{"kernel", Metric::instructions, 0, base}}),
        synthetic_run("head", "s", 1, {{"kernel", Metric::instructions, 0, head}})};
  };
  EXPECT_EQ(verdict_on(counts(1000.0, 1020.0)), RowVerdict::regressed);
  EXPECT_EQ(verdict_on(counts(1000.0, 1005.0)), RowVerdict::same);
}

TEST(Compare, TakesErrorsAtTheirWord) {
  const auto errors = [](double base, double head) {
    return std::vector<BenchmarkRun>{
        synthetic_run("base", "s", 0, {{"error/brdf", Metric::error, 0, base}}),
        synthetic_run("head", "s", 1, {{"error/brdf", Metric::error, 0, head}})};
  };
  EXPECT_EQ(verdict_on(errors(0.1, 0.10001)), RowVerdict::regressed);
  EXPECT_EQ(verdict_on(errors(0.1, 0.1 + 1e-9)), RowVerdict::same);
  EXPECT_EQ(verdict_on(errors(0.1, 0.09)), RowVerdict::faster);
}

// Repetitions of one process agree with each other: taken for independent, 3 processes would do.
TEST(Compare, CountsAProcessOnce) {
  std::vector<BenchmarkRun> runs;
  for (int i = 0; i < 6; ++i) {
    std::vector<Measurement> repetitions;
    for (int k = 0; k < 10; ++k) {
      repetitions.push_back({"kernel", Metric::nanoseconds, k, 100.0 + k});
    }
    runs.push_back(synthetic_run(i % 2 == 0 ? "base" : "head", "s", i, repetitions));
  }
  EXPECT_THAT(refusal_of(runs), AllOf(HasSubstr("kernel was run 3 times"), HasSubstr("7 runs")));
}

TEST(Compare, FindsCommitsByTheirBeginning) {
  auto runs = kSame;
  for (BenchmarkRun& run : runs) run.commit = run.commit == "base" ? "a1b2c3" : "a1ffff";
  EXPECT_EQ(compare(runs, "a1b", "a1f").base, "a1b2c3");
  EXPECT_THAT(refusal_of(runs, "a1", "a1f"), HasSubstr("'a1' is not unique"));
}

TEST(Compare, RefusesUnknownAndEqualCommits) {
  EXPECT_THAT(refusal_of(kSame, "base", "tail"),
              AllOf(HasSubstr("no runs of commit 'tail'"), HasSubstr("head"), HasSubstr("base")));
  EXPECT_THAT(refusal_of({}, "base", "head"), HasSubstr("none"));
  EXPECT_THAT(refusal_of(kSame, "", "head"), HasSubstr("no runs of commit ''"));
  EXPECT_THAT(refusal_of(kSame, "head", "head"), HasSubstr("the same commit"));
}

TEST(Compare, RefusesRunsOfDifferentSessions) {
  auto runs = kSame;
  for (BenchmarkRun& run : runs) run.session = run.commit;
  EXPECT_THAT(refusal_of(runs), HasSubstr("no session holds runs of both base and head"));
}

TEST(Compare, RefusesRunsOnDifferentMachinesOrCompilersOrFlags) {
  for (std::string BenchmarkRun::*member :
       {&BenchmarkRun::machine, &BenchmarkRun::compiler, &BenchmarkRun::flags}) {
    auto runs = kSame;
    runs.front().*member = "another";
    EXPECT_THAT(refusal_of(runs), AllOf(HasSubstr("cannot be compared"), HasSubstr("another")));
  }
}

TEST(Compare, LeavesOutSessionsElsewhere) {
  auto elsewhere = kSlow;
  for (BenchmarkRun& run : elsewhere) run.machine = "another";
  EXPECT_EQ(verdict_on(elsewhere + kSlowAgain), RowVerdict::suspected);
}

TEST(Compare, RefusesRunsThatAreNotInterleaved) {
  auto runs = kSame;
  for (BenchmarkRun& run : runs) run.started += run.commit == "head" ? 100 : 0;
  EXPECT_THAT(refusal_of(runs), HasSubstr("not interleaved"));
}

TEST(Compare, RefusesTooFewRuns) {
  EXPECT_THAT(refusal_of(synthetic_session({.processes = 6})),
              AllOf(HasSubstr("kernel was run 6 times"), HasSubstr("7 runs of each")));
  EXPECT_EQ(refusal_of(synthetic_session({.processes = 7})), "");
}

}  // namespace
}  // namespace lightproof
