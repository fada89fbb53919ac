// Map files on the command line: what is refused, what is repaired, what they are called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class MapFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Exit code 2 and one line that starts with the program's name and names the file; a second one
  /// if another command line would go on.
  void expect_refused(const Words& words, const testing::Matcher<std::string>& message) const {
    const Finished gate = quick_gate(words);
    EXPECT_EQ(gate.exit_code, 2);
    EXPECT_THAT(gate.out, IsEmpty());
    EXPECT_THAT(gate.err, AllOf(StartsWith("lightproof: "), HasSubstr(words.front()), message,
                                Not(HasSubstr("internal error"))));
    const bool has_remedy = gate.err.find("This would go on: ") != std::string::npos;
    EXPECT_EQ(std::count(gate.err.begin(), gate.err.end(), '\n'), has_remedy ? 2 : 1) << gate.err;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(MapFile, MissingIsRefused) { expect_refused({path("none.exr")}, HasSubstr("no such file")); }

TEST_F(MapFile, ThatIsAFolderIsRefused) {
  fs::create_directory(path("folder.exr"));
  expect_refused({path("folder.exr")}, HasSubstr("is a folder"));
}

TEST_F(MapFile, ThatIsTextIsRefusedWithTheFormatsThatAreRead) {
  write_bytes(path("text.exr"), "not a picture");
  expect_refused({path("text.exr")}, HasSubstr("OpenEXR, Radiance .hdr, PNG or JPEG"));
}

TEST_F(MapFile, ThatIsEmptyIsRefused) {
  write_bytes(path("empty.exr"), "");
  expect_refused({path("empty.exr")}, HasSubstr("0 bytes"));
}

TEST_F(MapFile, ThatIsCutOffIsRefused) {
  write_map(path("whole.exr"), {64, 32});
  const std::string bytes = bytes_of(path("whole.exr"));
  write_bytes(path("half.exr"), bytes.substr(0, bytes.size() / 2));
  expect_refused({path("half.exr")}, HasSubstr("cannot be read"));
}

TEST_F(MapFile, WithNanIsRefusedByTexelUnlessRepaired) {
  write_map(path("nan.exr"), {8, 4}, [](Grid<Rgb>& picture) { picture(5, 2).g = kNan; });
  expect_refused({path("nan.exr")}, AllOf(HasSubstr("1 texel with NaN"),
                                          HasSubstr("column 5, row 2"), HasSubstr("--repair")));
  const Finished repaired = quick_gate({path("nan.exr"), "--repair"});
  EXPECT_EQ(repaired.exit_code, 0) << repaired.out << repaired.err;
  EXPECT_THAT(repaired.err,
              AllOf(HasSubstr("nan.exr"), HasSubstr("Set to 0"), HasSubstr("column 5, row 2")));
  EXPECT_THAT(quick_gate({path("nan.exr"), "--repair", "-q"}).err, IsEmpty());
}

TEST_F(MapFile, WithNegativeTexelsIsRefused) {
  write_map(path("cold.exr"), {8, 4}, [](Grid<Rgb>& picture) {
    picture(3, 1).b = -1.0F;
    picture(4, 1).b = -2.0F;
  });
  expect_refused({path("cold.exr")}, AllOf(HasSubstr("2 texels with negative values"),
                                           HasSubstr("column 3, row 1"), HasSubstr("--repair")));
}

TEST_F(MapFile, ThatIsBlackIsRefused) {
  write_map(path("black.exr"), {8, 4},
            [](Grid<Rgb>& picture) { std::ranges::fill(picture.values(), Rgb(0.0F)); });
  expect_refused({path("black.exr")}, HasSubstr("every texel is black"));
}

TEST_F(MapFile, ThatIsBlackOnceRepairedIsRefused) {
  write_map(path("void.exr"), {8, 4},
            [](Grid<Rgb>& picture) { std::ranges::fill(picture.values(), Rgb(kNan)); });
  expect_refused({path("void.exr"), "--repair"}, HasSubstr("black"));
}

TEST_F(MapFile, ThatIsNotTwoToOneNeedsToBeAskedFor) {
  write_map(path("narrow.exr"), {9, 4});
  expect_refused({path("narrow.exr")}, AllOf(HasSubstr("9 x 4"), HasSubstr("--any-aspect")));
  EXPECT_EQ(quick_gate({path("narrow.exr"), "--any-aspect"}).exit_code, 0);
}

/// The command that a refusal offers, run by a shell in the folder of the map.
Finished run_offered(const Finished& refused, const fs::path& folder) {
  constexpr std::string_view kOffer = "This would go on: ";
  const std::size_t at = refused.err.find(kOffer);
  if (at == std::string::npos) return {-1, "", "no command in: " + refused.err, 0.0};
  return run({.words = {"bash", "-c", refused.err.substr(at + kOffer.size())}, .folder = folder});
}

TEST_F(MapFile, ThatIsRefusedComesWithTheCommandThatGoesOn) {
  const auto spoil = [](Grid<Rgb>& picture) { picture(5, 2).g = kNan; };
  write_map(path("it's mine.exr"), {8, 4}, spoil);
  write_map(path("narrow.exr"), {9, 4});
  write_map(path("both\n.exr"), {9, 4}, spoil);
  write_exr_file(path("window.exr"), numbered_picture({8, 4}), {.missing_columns = 2});
  write_luminance_chroma_exr(path("yc.exr"), {8, 4});
  write_exr_file(path("xyz.exr"), numbered_picture({8, 4}), {.xyz = true});
  for (const std::string name :
       {"it's mine.exr", "narrow.exr", "both\n.exr", "window.exr", "yc.exr", "xyz.exr"}) {
    const Finished refused = quick_gate({"--sampler", "alias", "--", name}, path(""));
    EXPECT_EQ(refused.exit_code, 2);
    const Finished offered = run_offered(refused, path(""));
    EXPECT_THAT(offered.exit_code, testing::AnyOf(0, 3)) << refused.err << offered.err;
    EXPECT_THAT(offered.out, HasSubstr("alias B"));
  }
}

TEST_F(MapFile, ThatNoFlagAcceptsComesWithoutACommand) {
  write_map(path("void.exr"), {8, 4},
            [](Grid<Rgb>& picture) { std::ranges::fill(picture.values(), Rgb(kNan)); });
  EXPECT_THAT(quick_gate({path("void.exr")}).err, Not(HasSubstr("This would go on")));
}

// What a file is called is the choice of whoever made it.
TEST_F(MapFile, CannotControlTheTerminalByItsName) {
  const std::string name = "sky\x1b[2J\r.exr";
  write_map(path(name), {8, 4}, [](Grid<Rgb>& picture) { picture(5, 2).g = kNan; });
  const auto control = testing::ContainsRegex("[\x1b\r]");
  const Finished refused = quick_gate({path(name)});
  EXPECT_THAT(refused.err, AllOf(HasSubstr("sky\\x1b[2J"), Not(control)));
  const Finished repaired = quick_gate({path(name), "--repair"});
  EXPECT_THAT(repaired.err, AllOf(HasSubstr("Set to 0"), Not(control)));
  EXPECT_THAT(repaired.out, AllOf(HasSubstr("sky\\x1b[2J"), Not(control)));
}

TEST_F(MapFile, AmongGoodOnesStopsTheRunBeforeAnythingIsPrinted) {
  const Finished gate = quick_gate({"constant", path("none.exr"), "step"});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.out, IsEmpty());
  EXPECT_THAT(gate.err, HasSubstr("none.exr"));
}

TEST_F(MapFile, IsCalledByItsStem) {
  write_map(path("lake.exr"));
  EXPECT_THAT(values_of(gate_results({path("lake.exr")}), "map"), ElementsAre("lake"));
}

TEST_F(MapFile, OfTheSameNameStaysApart) {
  fs::create_directory(path("a"));
  fs::create_directory(path("b"));
  write_map(path("a/sky.exr"));
  write_map(path("b/sky.exr"), {16, 8});
  write_map(path("sky-2.exr"));
  EXPECT_THAT(values_of(gate_results({path("a/sky.exr"), path("b/sky.exr")}), "map"),
              ElementsAre("sky", "sky-2"));
  EXPECT_THAT(
      values_of(gate_results({path("a/sky.exr"), path("b/sky.exr"), path("sky-2.exr")}), "map")
          .size(),
      3U);
}

TEST_F(MapFile, GivenTwiceStaysApart) {
  EXPECT_THAT(values_of(gate_results({"constant", "constant"}), "map"),
              ElementsAre("constant", "constant-2"));
}

TEST_F(MapFile, WithAnOddNameGivesJsonAllTheSame) {
  for (const std::string name :
       {"with space", "quote\"", "back\\slash", "line\nbreak", "\xff", ""}) {
    write_map(path(name + ".exr"));
    EXPECT_EQ(gate_results({path(name + ".exr")}).at("outcome"), "accept") << name;
  }
}

TEST_F(MapFile, WhoseNameStartsWithADashComesAfterTwoDashes) {
  write_map(path("-x.exr"));
  const Finished gate = quick_gate({"--", "-x.exr"}, path(""));
  EXPECT_EQ(gate.exit_code, 0) << gate.err;
}

TEST_F(MapFile, WithoutANameIsRefused) {
  const Finished gate = quick_gate({""});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, Not(StartsWith("lightproof: :")));
}

}  // namespace
}  // namespace lightproof::test
