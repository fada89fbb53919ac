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
  Words words = {"gate", "constant", "-n", "1024", "--size", "8x4"};
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
  EXPECT_THAT(gate_on(Terminal::none).err, IsEmpty());
  EXPECT_THAT(gate_on(Terminal::on_stdout).err, IsEmpty());
}

TEST(ProgressBar, IsNotDrawnIfQuiet) {
  EXPECT_THAT(gate_on(Terminal::on_stderr, {"-q"}).err, IsEmpty());
}

}  // namespace
}  // namespace lightproof::test
