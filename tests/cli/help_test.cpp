// Help, version and usage errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

struct HelpCase {
  std::string subcommand;
  Words mentioned;

  friend void PrintTo(const HelpCase& c, std::ostream* out) { *out << c.subcommand; }
};

class Help : public testing::TestWithParam<HelpCase> {};

TEST_P(Help, NamesEveryOptionOnStdout) {
  Words words = {"--help"};
  if (!GetParam().subcommand.empty()) words.insert(words.begin(), GetParam().subcommand);
  const Finished help = lightproof(words);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.err, IsEmpty());
  for (const std::string& text : GetParam().mentioned) EXPECT_THAT(help.out, HasSubstr(text));
}

const Words kCommon = {"MAP",          "--preset",     "--size",       "--repair",
                       "--any-aspect", "--seed",       "-t,--threads", "--color",
                       "-q,--quiet",   "--channels",   "--layer",      "--part",
                       "--luminance",  "-n,--samples", "--force",      "--progress"};

Words with_common(Words words) {
  words.insert(words.end(), kCommon.begin(), kCommon.end());
  return words;
}

INSTANTIATE_TEST_SUITE_P(
    Commands, Help,
    testing::Values(
        HelpCase{"",
                 {"study", "gate", "recommend", "stability", "info", "history", "list", "--version",
                  "Usage: lightproof"}},
        HelpCase{"gate",
                 with_common({"--sampler", "--density", "--level", "--json", "--junit",
                              "--markdown", "--github", "--sequential", "--rejections",
                              "--with-published", "Exit codes", "inconclusive", "powers of 1000"})},
        HelpCase{
            "check",
            {"DUMP", "--map", "--target", "--columns", "--axes", "--samples-preset", "--measure",
             "--density", "--densities", "--sequential", "--pdf-tolerance", "--must-detect",
             "weight or wr,wg,wb", "max is the largest", "list targets", "Exit codes"}},
        HelpCase{"study", with_common({"-o,--output", "--throughput", "--no-throughput",
                                       "--largest", "--no-self-test", "--no-stability",
                                       "--material", "--quality", "Exit codes"})},
        HelpCase{"recommend",
                 {"MAP", "--material", "--error", "--receiver", "--budget-ms", "--memory",
                  "--shading-points", "--no-verify", "--json", "--repair", "Exit codes"}},
        HelpCase{"stability",
                 {"--only", "--method", "--breaking-points", "--thorough", "--seed", "--threads",
                  "--json", "--html", "Exit codes"}},
        HelpCase{"info",
                 {"MAP", "--preset", "--repair", "--any-aspect", "--channels", "--layer", "--part",
                  "--luminance", "--json", "--drawing", "Exit codes"}},
        HelpCase{"history", {"add", "compare", "trend"}},
        HelpCase{"list",
                 {"samplers", "maps", "presets", "materials", "receivers", "estimators", "points",
                  "--json"}}),
    [](const auto& test) {
      return test.param.subcommand.empty() ? "lightproof" : test.param.subcommand;
    });

TEST(UsageErrors, RefuseEmptyNamesOfFiles) {
  for (const Words& words :
       {Words{"gate", "constant", "--json", ""}, Words{"study", "-o", ""},
        Words{"study", "--throughput", ""}, Words{"gate", "--rejections", ""}}) {
    const Finished finished = lightproof(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_THAT(finished.err, HasSubstr("empty"));
  }
}

TEST(Version, IsOneLine) {
  const Finished version = lightproof({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, MatchesRegex("lightproof [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(version.err, IsEmpty());
}

struct UsageCase {
  std::string name;
  Words words;
  std::string message;

  friend void PrintTo(const UsageCase& c, std::ostream* out) { *out << c.name; }
};

class Usage : public testing::TestWithParam<UsageCase> {};

TEST_P(Usage, ErrorIsExit2WithAReasonOnStderr) {
  const Finished finished = lightproof(GetParam().words);
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.out, IsEmpty());
  EXPECT_THAT(finished.err, HasSubstr(GetParam().message));
  EXPECT_THAT(finished.err, Not(HasSubstr("internal error")));
}

INSTANTIATE_TEST_SUITE_P(
    Errors, Usage,
    testing::Values(
        UsageCase{"NoSubcommand", {}, "subcommand is required"},
        UsageCase{"UnknownSubcommand", {"prove"}, "no command 'prove'"},
        UsageCase{"UnknownOption", {"gate", "--frobnicate"}, "--frobnicate"},
        UsageCase{"UnknownStudyOption", {"study", "--frobnicate"}, "--frobnicate"},
        UsageCase{"MissingValue", {"gate", "--size"}, "--size"},
        UsageCase{"TooFewSamples", {"gate", "-n", "1023"}, "--samples"},
        UsageCase{"TooManySamples", {"gate", "-n", "1099511627777"}, "--samples"},
        UsageCase{"NegativeSamples", {"gate", "-n", "-5"}, "--samples"},
        UsageCase{"SamplesOfAFractionalPower", {"gate", "-n", "1e3.5"}, "--samples"},
        UsageCase{"SamplesThatAreNotWhole", {"gate", "-n", "1.00005e4"}, "--samples"},
        UsageCase{"SamplesInMilli", {"gate", "-n", "4m"}, "2^22"},
        UsageCase{"TooManySamplesInPowers", {"gate", "-n", "2^64"}, "--samples"},
        UsageCase{"TooManySamplesInTens", {"gate", "-n", "1e20"}, "--samples"},
        UsageCase{"FractionalSamples", {"gate", "-n", "2048.5"}, "--samples"},
        UsageCase{"LevelAndSamples", {"gate", "--level", "quick", "-n", "4194304"}, "--samples"},
        UsageCase{"UnknownLevel", {"gate", "--level", "slow"}, "nightly"},
        UsageCase{"SamplesInWords", {"study", "-n", "many"}, "--samples"},
        UsageCase{"NegativeThreads", {"gate", "-t", "-1"}, "--threads"},
        UsageCase{"TooManyThreads", {"gate", "-t", "4097"}, "--threads"},
        UsageCase{"SeedInWords", {"gate", "--seed", "x"}, "--seed"},
        UsageCase{
            "SeedBeyond64Bits",
            {"gate", "constant", "--size", "8x4", "-n", "1024", "--seed", "18446744073709551616"},
            "--seed"},
        UsageCase{"UnknownColor", {"gate", "--color", "red"}, "always"},
        UsageCase{"UnknownDensity", {"gate", "--density", "D"}, "--density"},
        UsageCase{"UnknownRegistry", {"list", "cats"}, "samplers"},
        UsageCase{"NoRegistry", {"list"}, "WHAT"},
        UsageCase{"NoHistoryCommand", {"history"}, "subcommand is required"},
        UsageCase{"NoDatabase", {"history", "add", "r.json"}, "--db"},
        UsageCase{"NoResult", {"history", "add", "--db", "h.db"}, "RESULT"},
        UsageCase{"NoHead", {"history", "compare", "a", "--db", "h.db"}, "HEAD"},
        UsageCase{"NoPage", {"history", "trend", "--db", "h.db"}, "--output"},
        UsageCase{"LargestTooSmall", {"study", "--largest", "511"}, "--largest"},
        UsageCase{
            "LargestOfAFile", {"study", "--largest", "512", "--throughput", "f"}, "--largest"},
        UsageCase{
            "BothThroughputs", {"study", "--throughput", "f", "--no-throughput"}, "--throughput"}),
    [](const auto& test) { return test.param.name; });

class BadSize : public testing::TestWithParam<std::string> {};

TEST_P(BadSize, IsRefusedWithTheOptionAndTheText) {
  const Finished finished = lightproof({"gate", "constant", "--size", GetParam()});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith("lightproof: "), HasSubstr("--size"),
                                  HasSubstr("'" + GetParam() + "'"), HasSubstr("WIDTHxHEIGHT")));
}

INSTANTIATE_TEST_SUITE_P(Errors, BadSize,
                         testing::Values("64", "x", "64x", "x32", "0x32", "64x0", "-64x-32",
                                         "64x32x2", "64x32 ", "64X32", "32769x1", "big", ""));

TEST(SizeOfBuiltInMaps, OfTheSmallestMapsIsAccepted) {
  for (const char* size : {"1x1", "2x1", "1x2", "3x2"}) {
    const Finished finished =
        lightproof({"gate", "constant", "-n", "1024", "--must-detect", "10", "--size", size});
    EXPECT_EQ(finished.exit_code, 0) << size << "\n" << finished.out << finished.err;
  }
}

// Read as a 32-bit number, 2^32 + 64 is 64.
TEST(SizeOfBuiltInMaps, IsNotCutTo32Bits) {
  const Finished finished =
      lightproof({"gate", "constant", "-n", "1024", "--size", "4294967360x32"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("--size"));
}

TEST(SizeOfBuiltInMaps, IsCheckedEvenIfNoBuiltInMapUsesIt) {
  const TemporaryFolder folder;
  write_map(folder / "sky.exr");
  const Finished finished =
      lightproof({"gate", "sky.exr", "-n", "1024", "--size", "banana"}, folder / "");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("--size"));
}

struct Mistyped {
  std::string name;
  Words words;
  std::string complaint;

  friend void PrintTo(const Mistyped& m, std::ostream* out) { *out << m.name; }
};

class MistypedName : public testing::TestWithParam<Mistyped> {};

TEST_P(MistypedName, IsAnsweredWithTheNearestOne) {
  const Finished finished = lightproof(GetParam().words);
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.out, IsEmpty());
  EXPECT_THAT(finished.err, AllOf(StartsWith("lightproof"), HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    All, MistypedName,
    testing::Values(
        Mistyped{"Command", {"gat"}, "there is no command 'gat'; did you mean 'gate'?"},
        Mistyped{
            "CommandWithCapitals", {"List"}, "there is no command 'List'; did you mean 'list'?"},
        Mistyped{"CommandOfHistory",
                 {"history", "comapre", "a", "b"},
                 "lightproof history: there is no command 'comapre'; did you mean 'compare'?"},
        Mistyped{"Option",
                 {"gate", "--smapler", "alias"},
                 "lightproof gate: there is no option '--smapler'; did you mean '--sampler'?"},
        Mistyped{"OptionWithValue",
                 {"study", "--outptu=x"},
                 "lightproof study: there is no option '--outptu'; did you mean '--output'?"},
        Mistyped{"Map", {"gate", "sunsky"}, "no built-in map 'sunsky'; did you mean 'sun-sky'?"},
        Mistyped{"Sampler",
                 {"gate", "constant", "--sampler", "binary_serach"},
                 "there is no sampler 'binary_serach'; did you mean 'binary_search'?"},
        Mistyped{"SamplerOfDirections",
                 {"gate", "--sampler", "cosine_hemispere"},
                 "did you mean 'cosine_hemisphere'?"},
        Mistyped{"Mutant",
                 {"gate", "constant", "--sampler", "sine_at_edge"},
                 "did you mean 'sine-at-edge'?"},
        Mistyped{"Preset",
                 {"gate", "constant", "--preset", "OpenExr"},
                 "there is no preset 'OpenExr'; did you mean 'openexr'?"},
        Mistyped{
            "Density", {"gate", "--density", "b"}, "there is no density 'b'; did you mean 'B'?"},
        Mistyped{"Level", {"gate", "--level", "ful"}, "did you mean 'full'?"},
        Mistyped{"Registry", {"list", "sampler"}, "did you mean 'samplers'?"},
        Mistyped{"Colour", {"gate", "--color", "allways"}, "did you mean 'always'?"}),
    [](const auto& test) { return test.param.name; });

TEST(UnknownName, OfNothingNearIsAnsweredWithoutAGuess) {
  EXPECT_THAT(lightproof({"prove"}).err, Not(HasSubstr("did you mean")));
  EXPECT_THAT(quick_gate({"constant", "--preset", "maya"}).err, Not(HasSubstr("did you mean")));
}

TEST(UnknownName, CannotControlTheTerminal) {
  for (const Words& words : {Words{"\x1b[2J"}, Words{"gate", "--\x1b[2J"}, Words{"gate", "\x1b[2J"},
                             Words{"gate", "-n", "\x1b[2J"}, Words{"list", "\x1b[2J"}}) {
    const Finished finished = lightproof(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_THAT(finished.err, AllOf(HasSubstr("\\x1b[2J"), Not(HasSubstr("\x1b"))));
  }
}

TEST(UnknownName, OfASamplerListsTheKnownOnes) {
  const Finished finished = lightproof({"gate", "constant", "--sampler", "walker"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(
      finished.err,
      AllOf(HasSubstr("'walker'"), HasSubstr("samplers of maps: linear_scan_published, "),
            HasSubstr("binary_search"), HasSubstr("of directions: "),
            HasSubstr("cosine_hemisphere"), HasSubstr("mutants: "), HasSubstr("sine-at-edge")));
}

TEST(UnknownName, OfAPresetListsTheKnownOnes) {
  const TemporaryFolder folder;
  write_map(folder / "sky.exr");
  const Finished finished = quick_gate({"sky.exr", "--preset", "maya"}, folder / "");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("'maya'"), HasSubstr("z-up"), HasSubstr("pbrt-v4")));
}

TEST(UnknownName, OfAPresetIsRefusedEvenIfNoFileUsesIt) {
  const Finished finished = quick_gate({"constant", "--preset", "maya"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("'maya'"));
}

TEST(UnknownName, OfAMapListsTheBuiltInOnes) {
  const Finished finished = lightproof({"gate", "constnat"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err,
              AllOf(HasSubstr("constnat"), HasSubstr("constant"), HasSubstr("black-first-row")));
}

}  // namespace
}  // namespace lightproof::test
