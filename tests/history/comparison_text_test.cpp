#include "lightproof/history/comparison_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "synthetic_runs.h"

namespace lightproof {
namespace {

using test::synthetic_session;
using test::operator+;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Comparison of_ratio(double ratio, const std::string& kernel = "kernel") {
  auto runs = synthetic_session({.name = "1", .ratio = ratio, .seed = 1}) +
              synthetic_session({.name = "2", .started = 1000, .ratio = ratio, .seed = 2});
  for (BenchmarkRun& run : runs) {
    run.measurements[0].benchmark = kernel;
    run.measurements.push_back({"count", Metric::instructions, 0, 1000.0});
  }
  return compare(runs, "base", "head");
}

TEST(ComparisonTable, ShowsWhatWentWrongFirst) {
  const std::string table = comparison_table(of_ratio(1.5));
  EXPECT_LT(table.find("regressed  kernel"), table.find("same       count"));
  EXPECT_THAT(table, AllOf(HasSubstr("regressed: 1 of 2 measurements regressed"),
                           HasSubstr("machine; compiler; flags; 2 sessions")));
}

TEST(ComparisonTable, SaysWhatToDoAboutASuspicion) {
  const auto runs = synthetic_session({.ratio = 1.5});
  EXPECT_THAT(comparison_table(compare(runs, "base", "head")), HasSubstr("measure both"));
  EXPECT_THAT(comparison_table(of_ratio(1.0)), Not(HasSubstr("measure both")));
}

TEST(ComparisonMarkdown, IsATableThatNoNameCanBreak) {
  const std::string text = comparison_markdown(of_ratio(1.5, "a|b\nc"));
  EXPECT_THAT(text, HasSubstr("| regressed | a&#124;b c | ns |"));
  for (std::size_t at = text.find("\n| "); at != std::string::npos;
       at = text.find("\n| ", at + 1)) {
    const auto line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 10) << line;
  }
}

TEST(ComparisonAnnotations, AreNineOfEachLevelAndTheNumberOfTheOthers) {
  Comparison comparison = of_ratio(1.5, "a,b\n100%");
  EXPECT_EQ(comparison_annotations(comparison)
                .find("::error title=lightproof%3A a%2Cb%0A100%25::regressed: "),
            0U)
      << comparison_annotations(comparison);
  EXPECT_EQ(comparison_annotations(of_ratio(1.0)), "");
  comparison.rows.assign(12, comparison.rows[0]);
  const std::string text = comparison_annotations(comparison);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_THAT(text, HasSubstr("3 measurements more regressed"));
}

TEST(ComparisonTable, EndsWithTheRule) {
  EXPECT_THAT(comparison_table(of_ratio(1.5)),
              AllOf(HasSubstr("the larger of +5 %"), HasSubstr("instructions: beyond +1 %")));
}

TEST(ComparisonTable, LetsNoNameControlTheTerminal) {
  EXPECT_THAT(comparison_table(of_ratio(1.5, "a\x1b[2J")),
              AllOf(HasSubstr("a\\x1b[2J"), Not(HasSubstr("\x1b"))));
}

TEST(ComparisonJson, HasTheRowsAndTheirJudgements) {
  const auto json = nlohmann::json::parse(
      comparison_json(of_ratio(1.5), {"1.2.3", "abc", "lightproof history compare a b"}));
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["commit"], "abc");
  EXPECT_EQ(json["command"], "lightproof history compare a b");
  EXPECT_EQ(json["outcome"], "regressed");
  EXPECT_EQ(json["sessions"].size(), 2U);
  ASSERT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["rows"][0]["benchmark"], "kernel");
  EXPECT_EQ(json["rows"][0]["latest"]["base_runs"], 15);
  EXPECT_NEAR(json["rows"][0]["latest"]["ratio"].get<double>(), 1.5, 0.05);
  EXPECT_EQ(json["rows"][0]["earlier"]["change"], "slower");
  EXPECT_TRUE(json["rows"][1]["latest"]["log10_p"].is_null());
  EXPECT_EQ(nlohmann::json::parse(comparison_json(of_ratio(1.0), {}))["outcome"], "passed");
}

}  // namespace
}  // namespace lightproof
