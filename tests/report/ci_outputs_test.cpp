#include "lightproof/report/ci_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "fixture.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_table.h"

namespace lightproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// `rejected` rejections after one accepted test, with awkward names.
GateResult gate_with(std::size_t rejected) {
  GateResult gate{1e-6, 4194304, 7, {testing::accepted_test("binary_search", "city")}};
  for (std::size_t i = 0; i < rejected; ++i) {
    TestRecord test = testing::accepted_test("mine", "a|b<c>&\"d\"");
    test.outcome = Outcome::reject;
    test.log10_p = -20.0 - static_cast<double>(i);
    test.detail = "row 0\nis 100% dark";
    gate.tests.push_back(test);
  }
  gate.rejections.push_back({"mine", "B", "a|b<c>&\"d\"", "upside-down", "t flipped", {}, {}});
  return gate;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Junit, HasOneCaseATestWithEverythingNeededToRepeatIt) {
  const std::string xml = gate_junit(gate_with(1), true);
  EXPECT_THAT(xml, HasSubstr("tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\""));
  EXPECT_EQ(count_of(xml, "<testcase "), 2U);
  EXPECT_EQ(count_of(xml, "name=\"replay\""), 2U);
  EXPECT_THAT(xml, HasSubstr("looks like: t flipped"));
  EXPECT_THAT(xml, HasSubstr("a|b&lt;c&gt;&amp;"));
  EXPECT_THAT(xml, Not(HasSubstr("b<c>")));
}

TEST(CiOutputs, NameWhatWasLeftOut) {
  GateResult gate = gate_with(0);
  gate.left_out = {{"alias", "B", "cube", "no rows of one height"},
                   {"guide_table", "B", "cube", "no rows of one height"},
                   {"bilinear", "C", "cube", "no such <look-up>"}};
  const std::string xml = gate_junit(gate, true);
  EXPECT_THAT(xml, HasSubstr("tests=\"4\" failures=\"0\" errors=\"0\" skipped=\"3\""));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"left out: no such &lt;look-up&gt;\"/>"));
  for (const std::string& text : {gate_markdown(gate, true), gate_annotations(gate, true)}) {
    EXPECT_THAT(text, HasSubstr("cube, density B: 2 samplers left out: no rows of one height"));
    EXPECT_THAT(text, HasSubstr("cube, density C: 1 sampler left out: no such"));
  }
}

TEST(ReplayCommand, IsQuotedAndComplete) {
  GateResult gate = gate_with(1);
  gate.input_options = " --repair";
  gate.tests[1].source = "maps/it's mine.exr";
  EXPECT_EQ(replay_command(gate, gate.tests[1]),
            "lightproof gate 'maps/it'\\''s mine.exr' --sampler mine --density B --repair "
            "--samples 4194304 --seed 7");
  gate.sequential = true;
  gate.family = 12;
  gate.must_detect = 0.25;
  EXPECT_THAT(replay_command(gate, gate.tests[1]),
              ::testing::EndsWith(" --seed 7 --sequential --family 12 --must-detect 0.25"));
}

TEST(Junit, SkipsTestsThatAreNotRun) {
  GateResult gate = gate_with(0);
  gate.tests[0].outcome = Outcome::not_run;
  gate.tests[0].detail = "2 samples there are too few";
  const std::string xml = gate_junit(gate, true);
  EXPECT_THAT(xml, HasSubstr("tests=\"1\" failures=\"0\" errors=\"0\" skipped=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"not run: 2 samples there are too few\"/>"));
}

TEST(Junit, SkipsKnownDefectsUnlessTheyCount) {
  GateResult gate = gate_with(1);
  gate.tests[1].known_defect = true;
  EXPECT_THAT(gate_junit(gate, false), HasSubstr("failures=\"0\" errors=\"0\" skipped=\"1\""));
  EXPECT_THAT(gate_junit(gate, true), HasSubstr("failures=\"1\" errors=\"0\" skipped=\"0\""));
}

TEST(Outputs, SayWhatIsLimitedByResolution) {
  GateResult gate = gate_with(0);
  gate.tests[0].outcome = Outcome::resolution_limited;
  EXPECT_THAT(gate_junit(gate, true), AllOf(HasSubstr("failures=\"0\" errors=\"0\" skipped=\"1\""),
                                            HasSubstr("<skipped message=\"resolution-limited: ")));
  EXPECT_THAT(gate_markdown(gate, true),
              AllOf(HasSubstr("\u2248 resolution-limited"), HasSubstr(", 1 resolution-limited;")));
  EXPECT_THAT(gate_annotations(gate, true),
              AllOf(HasSubstr("::warning "), HasSubstr("1 test limited"), Not(HasSubstr("error"))));
  EXPECT_THAT(gate_table(gate, true),
              AllOf(HasSubstr("\u2248 resolution-limited"), HasSubstr("Resolution-limited tests")));
  StudyResult study;
  study.gate = gate;
  EXPECT_THAT(headline(study), HasSubstr("as far as rounding lets be seen"));
}

// The exit code does not count a published sampler's open tests, and nor does a CI server.
TEST(Junit, CountsNoOpenTestOfASamplerWithKnownDefects) {
  GateResult gate = gate_with(0);
  gate.tests[0].outcome = Outcome::inconclusive;
  gate.tests[0].known_defect = true;
  EXPECT_THAT(gate_junit(gate, false), HasSubstr("failures=\"0\" errors=\"0\" skipped=\"1\""));
  EXPECT_THAT(gate_junit(gate, true), HasSubstr("failures=\"0\" errors=\"1\" skipped=\"0\""));
}

TEST(Markdown, NamesTheWorstFirstAndStaysBelowItsLimit) {
  const std::string few = gate_markdown(gate_with(3), true);
  EXPECT_LT(few.find("log10 p -22"), few.find("log10 p -21"));
  EXPECT_THAT(few, HasSubstr("| a&#124;b&lt;c&gt;&amp;\"d\" |"));
  EXPECT_THAT(few, Not(HasSubstr("more")));
  const std::string many = gate_markdown(gate_with(2000), true);
  EXPECT_LT(many.size(), 60000U);
  EXPECT_THAT(many, HasSubstr(" more\n"));
  EXPECT_THAT(gate_markdown(gate_with(0), true), HasSubstr("0 rejected"));
}

/// Each sampler on each map has two rejected tests.
GateResult gate_with_runs(std::size_t runs) {
  GateResult gate{1e-6, 4194304, 7, {}};
  for (std::size_t i = 0; i < runs; ++i) {
    for (const double log10_p : {-20.0, -30.0 - static_cast<double>(i)}) {
      TestRecord test = testing::accepted_test("mine", "map" + std::to_string(i));
      test.outcome = Outcome::reject;
      test.log10_p = log10_p;
      test.test = log10_p < -20.0 ? TestId::rows : TestId::texels;
      test.detail = "row 0\nis 100% dark";
      gate.tests.push_back(test);
    }
  }
  return gate;
}

TEST(Annotations, AreOneForEachSamplerAndMap) {
  GateResult gate = gate_with_runs(1);
  gate.rejections.push_back({"mine", "B", "map0", "upside-down", "t flipped", {}, {}});
  const std::string text = gate_annotations(gate, true);
  EXPECT_EQ(count_of(text, "::error "), 1U) << text;
  EXPECT_EQ(count_of(text, "\n"), 1U) << text;
  EXPECT_THAT(text, AllOf(HasSubstr("title=lightproof%3A mine B on map0::"),
                          HasSubstr("2 of 2 tests rejected, the worst reference/rows: log10 p -30"),
                          HasSubstr("row 0%0Ais 100%25 dark"),
                          HasSubstr("looks like: t flipped (upside-down)"),
                          HasSubstr("Again: lightproof gate map0 --sampler mine")));
}

TEST(Annotations, AreNineAndTheNumberOfTheOthers) {
  const std::string text = gate_annotations(gate_with_runs(12), true);
  EXPECT_EQ(count_of(text, "::error "), 10U);
  EXPECT_LT(text.find("map11"), text.find("map10")) << "the least likely first";
  EXPECT_THAT(text, HasSubstr("3 runs more rejected"));
  EXPECT_EQ(gate_annotations(gate_with(0), true), "");
}

TEST(Annotations, LeaveOutKnownDefectsThatDoNotCount) {
  GateResult gate = gate_with_runs(1);
  for (TestRecord& test : gate.tests) test.known_defect = true;
  EXPECT_EQ(count_of(gate_annotations(gate, true), "::error "), 1U);
  EXPECT_EQ(gate_annotations(gate, false), "");
}

TEST(Junit, GivesProbabilitiesAsNumbers) {
  GateResult gate = gate_with(1);
  gate.tests[0].log10_p = -0.681;
  gate.tests[1].log10_p = -400.5;
  const std::string xml = gate_junit(gate, true);
  EXPECT_THAT(xml, AllOf(HasSubstr("name=\"p\" value=\"0.2084\""),
                         HasSubstr("name=\"log10_p\" value=\"-0.681\""),
                         HasSubstr("name=\"p\" value=\"3.16e-401\"")));
  gate.tests[1].log10_p.reset();
  EXPECT_EQ(count_of(gate_junit(gate, true), "name=\"p\""), 1U) << "an exact check has none";
}

}  // namespace
}  // namespace lightproof
