// Colours and the progress bar: only where a person is looking.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kEscape = "\x1b[";
const std::string kGreen = "\x1b[32m";

struct ColourCase {
  std::string name;
  Words words;
  Words environment;
  Terminal terminal;
  bool coloured;

  friend void PrintTo(const ColourCase& c, std::ostream* out) { *out << c.name; }
};

class Colour : public testing::TestWithParam<ColourCase> {};

TEST_P(Colour, IsUsedWhereItIsWanted) {
  Words words = {"gate", "constant", "-n", "1024", "--must-detect", "10", "--size", "8x4"};
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  Command command = lightproof_command(words);
  command.environment = GetParam().environment;
  command.terminal = GetParam().terminal;
  const std::string out = run(command).out;
  EXPECT_THAT(out, HasSubstr("accept"));
  if (GetParam().coloured) {
    EXPECT_THAT(out, HasSubstr(kGreen));
  } else {
    EXPECT_THAT(out, Not(HasSubstr(kEscape)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Stdout, Colour,
    testing::Values(
        ColourCase{"AutoInAPipe", {}, {}, Terminal::none, false},
        ColourCase{"AutoOnATerminal", {}, {}, Terminal::on_stdout, true},
        ColourCase{"AutoWithOnlyStderrATerminal", {}, {}, Terminal::on_stderr, false},
        ColourCase{"NoColorOnATerminal", {}, {"NO_COLOR=1"}, Terminal::on_stdout, false},
        // https://no-color.org: only if not empty.
        ColourCase{"EmptyNoColorOnATerminal", {}, {"NO_COLOR="}, Terminal::on_stdout, true},
        ColourCase{"AlwaysInAPipe", {"--color", "always"}, {}, Terminal::none, true},
        ColourCase{
            "AlwaysDespiteNoColor", {"--color", "always"}, {"NO_COLOR=1"}, Terminal::none, true},
        ColourCase{"NeverOnATerminal", {"--color", "never"}, {}, Terminal::on_stdout, false}),
    [](const auto& test) { return test.param.name; });

Finished gate_on(Terminal terminal, const Words& more = {}) {
  Words words = {"gate", "constant", "step", "-n", "65536", "--size", "32x16"};
  words.insert(words.end(), more.begin(), more.end());
  Command command = lightproof_command(words);
  command.terminal = terminal;
  return run(command);
}

TEST(ProgressBar, IsDrawnAndWipedOnATerminal) {
  const Finished gate = gate_on(Terminal::on_stderr);
  EXPECT_EQ(gate.exit_code, 0);
  EXPECT_THAT(gate.err,
              AllOf(HasSubstr("%"), HasSubstr("gate"), HasSubstr("["), EndsWith("\r\x1b[K")));
  EXPECT_THAT(gate.out, AllOf(Not(HasSubstr("\r")), Not(HasSubstr(kEscape))));
}

TEST(ProgressBar, IsNotDrawnIntoAPipe) {
  // Where it takes minutes there are lines.
  const auto no_bar = AllOf(Not(HasSubstr("\r")), Not(HasSubstr("[")));
  EXPECT_THAT(gate_on(Terminal::none).err, no_bar);
  EXPECT_THAT(gate_on(Terminal::on_stdout).err, no_bar);
}

/// What both streams show on one terminal, in their order.
TEST(ProgressBar, IsWipedBeforeTheTable) {
  const std::string script = "exec \"$0\" gate constant step -n 65536 --size 32x16 >&2";
  const Finished gate =
      run({.words = {"sh", "-c", script, program()}, .terminal = Terminal::on_stderr});
  EXPECT_EQ(gate.exit_code, 0);
  const std::size_t table = gate.err.find("verdict");
  ASSERT_NE(table, std::string::npos) << gate.err;
  ASSERT_GE(table, 4U);
  EXPECT_EQ(gate.err.substr(table - 4, 4), "\r\x1b[K") << gate.err;
}

TEST(ProgressLines, ArePrintedWhereNobodySeesABar) {
  Words words = {"gate", "sun-sky", "--size", "64x32", "-n", "2^20", "-t", "1", "--progress", "1"};
  const Finished gate = Process(lightproof_command(words)).wait(std::chrono::seconds(600));
  EXPECT_EQ(gate.exit_code, 0);
  EXPECT_THAT(gate.err, testing::ContainsRegex("(^|\n)gate: [0-9]+ %(, [0-9hmins ]+ left)?\n"));
  EXPECT_THAT(gate.err, Not(HasSubstr("\r")));
  words.back() = "0";
  EXPECT_THAT(Process(lightproof_command(words)).wait(std::chrono::seconds(600)).err, IsEmpty());
}

TEST(ProgressLines, AreNotPrintedIfQuiet) {
  const Finished gate = Process(lightproof_command({"gate", "sun-sky", "--size", "64x32", "-n",
                                                    "2^20", "-t", "1", "--progress", "1", "-q"}))
                            .wait(std::chrono::seconds(600));
  EXPECT_THAT(gate.err, IsEmpty());
}

TEST(ProgressBar, IsNotDrawnIfQuiet) {
  EXPECT_THAT(gate_on(Terminal::on_stderr, {"-q"}).err, IsEmpty());
}

}  // namespace
}  // namespace lightproof::test
