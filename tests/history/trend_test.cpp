#include "lightproof/history/trend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/history/trend_page.h"
#include "synthetic_runs.h"

namespace lightproof {
namespace {

using test::synthetic_run;

std::string commit_name(int number) { return "c" + std::to_string(number); }

/// Twenty commits, three runs each; the last eight take 30 % longer.
std::vector<BenchmarkRun> twenty_commits() {
  const RandomStream stream("history/trend", 1);
  std::vector<BenchmarkRun> runs;
  for (int i = 0; i < 60; ++i) {
    const int commit = i / 3;
    const double level = commit < 12 ? 100.0 : 130.0;
    const double noise = 1.0 + 0.02 * stream.point(static_cast<std::uint64_t>(i)).s;
    runs.push_back(synthetic_run(commit_name(commit), "s" + std::to_string(commit), i,
                                 {{"kernel", Metric::nanoseconds, 0, level * noise},
                                  {"kernel", Metric::instructions, 0, commit < 5 ? 50.0 : 51.0}}));
  }
  return runs;
}

TEST(Trend, HasALineForEachBenchmarkMetricAndSetting) {
  auto runs = twenty_commits();
  runs.back().machine = "another";
  const std::vector<TrendLine> lines = trend_lines(runs);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].machine, "another");
  EXPECT_EQ(lines[0].points.size(), 1U);
  EXPECT_EQ(lines[2].points.size(), 20U);
}

TEST(Trend, MarksWhereTheTimeChanges) {
  const std::vector<TrendLine> lines = trend_lines(twenty_commits());
  ASSERT_EQ(lines.size(), 2U);
  ASSERT_EQ(lines[0].metric, Metric::nanoseconds);
  ASSERT_EQ(lines[0].changes.size(), 1U);
  EXPECT_EQ(lines[0].points[lines[0].changes[0].first].commit, "c12");
  EXPECT_NEAR(lines[0].changes[0].ratio, 1.3, 0.03);
}

TEST(Trend, MarksEveryStepOfInstructions) {
  const TrendLine line = trend_lines(twenty_commits()).at(1);
  ASSERT_EQ(line.metric, Metric::instructions);
  ASSERT_EQ(line.changes.size(), 1U);
  EXPECT_EQ(line.changes[0].first, 5U);
}

// A machine that is slow for one session shifts all runs of it alike: as runs they would be a
// change, as one commit they are one point among twenty.
TEST(Trend, TakesACommitForOneValue) {
  std::vector<BenchmarkRun> runs;
  for (int i = 0; i < 200; ++i) {
    const double level = i / 20 == 9 ? 110.0 : 100.0;
    runs.push_back(synthetic_run(commit_name(i / 20), "s" + std::to_string(i / 20), i,
                                 {{"kernel", Metric::nanoseconds, 0, level + 0.01 * (i % 20)}}));
  }
  const TrendLine line = trend_lines(runs).at(0);
  EXPECT_EQ(line.points.size(), 10U);
  EXPECT_EQ(line.points[0].runs, 20U);
  EXPECT_TRUE(line.changes.empty());
}

TEST(Trend, OrdersCommitsByWhenTheyWereFirstMeasured) {
  std::vector<BenchmarkRun> runs;
  for (const char* commit : {"b", "a", "b", "c"}) {
    runs.push_back(synthetic_run(commit, "s", static_cast<std::int64_t>(runs.size()),
                                 {{"kernel", Metric::nanoseconds, 0, 1.0}}));
  }
  const TrendLine line = trend_lines(runs).at(0);
  ASSERT_EQ(line.points.size(), 3U);
  EXPECT_EQ(line.points[0].commit, "b");
  EXPECT_EQ(line.points[0].runs, 2U);
  EXPECT_EQ(line.points[2].commit, "c");
}

/// Thirty benchmarks over thirty sessions, three runs each. What state the machine is in lasts for
/// some sessions, and all benchmarks feel it. From session 18 on the last one takes `factor` as
/// long.
std::vector<BenchmarkRun> thirty_sessions(std::uint64_t seed, double factor) {
  const RandomStream stream("history/sessions", 1, seed);
  const auto normal = [&](std::uint64_t i) { return normal_quantile(stream.point(i).s + 0x1p-54); };
  std::vector<BenchmarkRun> runs;
  double state = normal(0);
  for (int session = 0; session < 30; ++session) {
    for (int run = 0; run < 3; ++run) {
      std::vector<Measurement> times;
      for (int k = 0; k < 30; ++k) {
        const auto number = static_cast<std::uint64_t>(1000 + (session * 3 + run) * 30 + k);
        const double level = k == 29 && session >= 18 ? 100.0 * factor : 100.0;
        times.push_back({"kernel-" + std::to_string(k), Metric::nanoseconds, 0,
                         level * std::exp(0.02 * state + 0.01 * normal(number))});
      }
      runs.push_back(synthetic_run(commit_name(session), "s" + std::to_string(session),
                                   3 * session + run, std::move(times)));
    }
    state = 0.8 * state + 0.6 * normal(static_cast<std::uint64_t>(session + 1));
  }
  return runs;
}

TEST(Trend, TakesALastingStateOfTheMachineForNoChange) {
  int pages = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto lines = trend_lines(thirty_sessions(seed, 1.0), {0.05, 1.0});
    pages += std::ranges::any_of(lines, [](const auto& line) { return !line.changes.empty(); });
  }
  // Binomial, five standard deviations above the mean of 2.
  EXPECT_LE(pages, 2.0 + 5.0 * std::sqrt(40 * 0.05 * 0.95));
}

TEST(Trend, SeesAChangeOfOneAmongThirty) {
  const auto lines = trend_lines(thirty_sessions(100, 1.4));
  for (const TrendLine& line : lines) {
    EXPECT_EQ(line.changes.size(), line.benchmark == "kernel-29" ? 1U : 0U) << line.benchmark;
    for (const ChangePoint& change : line.changes) {
      EXPECT_EQ(line.points[change.first].commit, "c18");
    }
  }
}

TEST(TrendChart, HasEveryCommitLevelAndChange) {
  const TrendLine line = trend_lines(twenty_commits()).at(0);
  const auto chart = nlohmann::json::parse(trend_chart(line));
  ASSERT_EQ(chart["layer"].size(), 5U);
  EXPECT_EQ(chart["layer"][0]["data"]["values"].size(), 20U);
  EXPECT_EQ(chart["layer"][0]["data"]["values"][0]["number"], 1);
  EXPECT_EQ(chart["layer"][0]["data"]["values"][19]["number"], 20);
  EXPECT_EQ(chart["layer"][1]["data"]["values"].size(), 2U);
  EXPECT_EQ(chart["layer"][3]["data"]["values"].size(), 1U);
  EXPECT_EQ(chart["layer"][3]["data"]["values"][0]["commit"], "c12");
}

/// Whether the page has this text; a page is too long to be printed.
bool has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(TrendPage, SaysWhatChangedAndSince) {
  const std::string page = trend_page(trend_lines(twenty_commits()), "1.2.3");
  EXPECT_TRUE(has(page, "<h1>2 of 2 lines changed their level</h1>"));
  EXPECT_TRUE(has(page, "kernel: 30\u00a0% more since c12"));
  EXPECT_TRUE(has(page, "kernel: 2.0\u00a0% more since c5"));
  EXPECT_TRUE(has(page, "Made by Lightproof 1.2.3"));
}

TEST(TrendPage, NeverContainsTheMarkupOfANameAsMarkup) {
  auto runs = twenty_commits();
  for (BenchmarkRun& run : runs) {
    for (Measurement& m : run.measurements) m.benchmark = "<script>alert(1)</script>";
  }
  EXPECT_FALSE(has(trend_page(trend_lines(runs), "1"), "<script>alert"));
}

TEST(TrendPage, OfNothingSaysSo) {
  EXPECT_TRUE(has(trend_page({}, "1"), "Nothing has been measured yet"));
}

}  // namespace
}  // namespace lightproof
