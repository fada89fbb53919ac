#include "lightproof/report/gate_table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "fixture.h"

namespace lightproof {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

GateResult mixed_gate() {
  GateResult gate{1e-6, 4194304, 7, {}};
  gate.tests = {testing::accepted_test("binary_search", "city"),
                testing::accepted_test("binary_search", "city"),
                testing::accepted_test("a_sampler_with_a_long_name", "caf\u00e9")};
  gate.tests[1].test = TestId::phi;
  gate.tests[1].log10_p = -3.0;
  gate.tests[2].outcome = Outcome::reject;
  gate.tests[2].log10_p = -88.25;
  gate.tests[2].detail = "row 0 is never drawn";
  return gate;
}

TEST(GateTable, HasOneLinePerRunWithItsWorstTest) {
  const std::vector<std::string> lines = lines_of(gate_table(mixed_gate(), false));
  ASSERT_GE(lines.size(), 3U);
  EXPECT_NE(lines[1].find("\u2713 accept  binary_search B"), std::string::npos) << lines[1];
  EXPECT_NE(lines[1].find("2/2"), std::string::npos) << lines[1];
  EXPECT_NE(lines[1].find("reference/phi (Kuiper)"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("\u2717 reject"), std::string::npos) << lines[2];
  EXPECT_NE(lines[2].find("0/1"), std::string::npos) << lines[2];
}

TEST(GateTable, AlignsColumnsByCharactersNotBytes) {
  const std::vector<std::string> lines = lines_of(gate_table(mixed_gate(), false));
  const auto column = [](const std::string& line, const std::string& text) {
    const std::string before = line.substr(0, line.find(text));
    return std::count_if(before.begin(), before.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  };
  EXPECT_EQ(column(lines[1], "reference/"), column(lines[2], "reference/"));
  EXPECT_EQ(column(lines[0], "passed"), column(lines[1], "2/2"));
}

TEST(GateTable, TellsEveryRejectedTestInFull) {
  const std::string text = gate_table(mixed_gate(), false);
  EXPECT_NE(text.find("a_sampler_with_a_long_name B on caf\u00e9: reference/bins 16x32\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("log10 p -88.2"), std::string::npos) << text;
  EXPECT_NE(text.find("row 0 is never drawn"), std::string::npos) << text;
  EXPECT_NE(text.find("3 tests, 1 rejected, 0 inconclusive; family-wise error 1e-6, 4,194,304 "
                      "samples per run, seed 7\n"),
            std::string::npos)
      << text;
}

TEST(GateTable, ShowsKnownDefectsInASectionOfTheirOwn) {
  GateResult gate = mixed_gate();
  gate.tests[2].known_defect = true;
  gate.rejections.push_back({.sampler = gate.tests[2].sampler,
                             .density_space = "B",
                             .map = gate.tests[2].map,
                             .looks_like = "row",
                             .diagnosis = "a row is dark",
                             .residual = {},
                             .row_divergence = {}});
  const std::string text = gate_table(gate, false, Colour::ansi);
  const std::size_t section = text.find("Kept as published, with known defects: demonstration");
  ASSERT_NE(section, std::string::npos) << text;
  for (const char* word : {"\u2717 reject", "Rejected tests", "Diagnosis"}) {
    EXPECT_GT(text.find(word), section) << word << text;
  }
  EXPECT_EQ(text.find("\x1b[31m"), std::string::npos) << "red means a verdict";
  EXPECT_EQ(lines_of(text).end()[-2].find("\x1b[32m\u2713 accept: 2 tests, 0 rejected"), 0U)
      << text;
}

TEST(GateTable, SaysHowOftenTheWorstCellWasDrawn) {
  GateResult gate = mixed_gate();
  gate.tests = {gate.tests[2]};
  gate.tests[0].test = TestId::worst_texel;
  gate.tests[0].effect = 12.6;
  gate.tests[0].minimum_detectable_effect = 0.25;
  EXPECT_NE(
      gate_table(gate, false).find("effect 13.6x expected, minimum detectable 1.25x expected"),
      std::string::npos)
      << gate_table(gate, false);
  gate.tests[0].effect = -1.0;
  EXPECT_NE(gate_table(gate, false).find("effect never drawn"), std::string::npos);
}

TEST(GateTable, LeavesOutDegreesOfFreedomWhereThereAreNone) {
  GateResult gate = mixed_gate();
  EXPECT_NE(gate_table(gate, false).find("1023 degrees of freedom"), std::string::npos);
  gate.tests[2].dof = 0.0;
  EXPECT_EQ(gate_table(gate, false).find("degrees of freedom"), std::string::npos);
  EXPECT_EQ(gate_table(gate, false).find("dof"), std::string::npos);
}

TEST(GateTable, LetsNoNameControlTheTerminal) {
  GateResult gate = mixed_gate();
  for (TestRecord& test : gate.tests) test.map = "sky\x1b[2J\r";
  gate.tests[2].detail = "cell\x1b]0;title";
  gate.rejections.push_back({.sampler = gate.tests[2].sampler,
                             .density_space = "B",
                             .map = gate.tests[2].map,
                             .looks_like = "row",
                             .diagnosis = "a row is dark",
                             .residual = {},
                             .row_divergence = {}});
  const std::string text = gate_table(gate, true);
  EXPECT_EQ(text.find_first_of("\x1b\r"), std::string::npos) << text;
  EXPECT_NE(text.find("sky\\x1b[2J"), std::string::npos) << text;
}

TEST(GateTable, CountsKnownDefectsWithTheRestWhereTheyWereAskedFor) {
  GateResult gate = mixed_gate();
  gate.tests[2].known_defect = true;
  const std::string text = gate_table(gate, true);
  EXPECT_NE(text.find("\u2717 reject: 3 tests, 1 rejected"), std::string::npos) << text;
  EXPECT_EQ(text.find("Kept as published"), std::string::npos) << text;
}

TEST(GateTable, HasColourOnlyOnRequest) {
  EXPECT_EQ(gate_table(mixed_gate(), false).find('\x1b'), std::string::npos);
  const std::string coloured = gate_table(mixed_gate(), false, Colour::ansi);
  EXPECT_NE(coloured.find("\x1b[31m\u2717 reject"), std::string::npos);
  EXPECT_NE(coloured.find("\x1b[32m\u2713 accept"), std::string::npos);
}

TEST(GateTable, SaysThatNothingRanIsInconclusive) {
  EXPECT_NE(gate_table({}, false).find("? inconclusive: 0 tests"), std::string::npos);
}

}  // namespace
}  // namespace lightproof
