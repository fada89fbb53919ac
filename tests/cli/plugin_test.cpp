// lightproof gate --plugin and lightproof new-plugin, as somebody who writes a sampler meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "lightproof/core/temporary_folder.h"
#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string plugin(const std::string& name) {
  return std::string(LIGHTPROOF_TEST_PLUGINS) + "/" + name + ".so";
}

/// The gate over plug-ins, on a map on which 2^17 samples are enough.
Finished gate_of(const Words& plugins, const Words& more = {}, const fs::path& folder = ".") {
  Words words = {"gate", "sun-sky", "--size", "32x16", "-n", "131072", "--plugin-seconds", "1.5"};
  for (const std::string& name : plugins) {
    words.insert(words.end(), {"--plugin", plugin(name)});
  }
  words.insert(words.end(), more.begin(), more.end());
  return lightproof(words, folder);
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(GatePlugin, AcceptsTheOneThatIsRightAndTestsNoOther) {
  const TemporaryFolder folder;
  const Finished finished = gate_of({"correct"}, {"--json", "g.json"}, folder / "");
  EXPECT_EQ(finished.exit_code, 0) << finished.out << finished.err;
  EXPECT_EQ(finished.err, "");
  EXPECT_THAT(values_of(json_of(folder / "g.json"), "sampler"), ElementsAre("correct"));
  EXPECT_THAT(values_of(json_of(folder / "g.json"), "density"), ElementsAre("C"));
  expect_valid("gate.schema.json", folder / "g.json");
}

TEST(GatePlugin, RejectsInEveryFormWithTheCommandThatDrawsItAgain) {
  const TemporaryFolder folder;
  const Finished finished = gate_of({"flipped-t"},
                                    {"--junit", "g.xml", "--markdown", "g.md", "--github",
                                     "--rejections", "rejected", "--json", "g.json"},
                                    folder / "");
  EXPECT_EQ(finished.exit_code, 1);
  const std::string again = "--plugin " + plugin("flipped-t") + " --plugin-seconds 1.5 --density C";
  EXPECT_THAT(finished.out, AllOf(HasSubstr("flipped-t C on sun-sky looks like"), HasSubstr(again),
                                  HasSubstr("::error title=lightproof")));
  EXPECT_THAT(text_of(folder / "g.xml"), AllOf(HasSubstr("<failure"), HasSubstr(again)));
  EXPECT_THAT(text_of(folder / "g.md"), HasSubstr("| flipped-t C | sun-sky |"));
  EXPECT_THAT(names_in(folder / "rejected"), Contains(HasSubstr("flipped-t")));
  expect_valid("gate.schema.json", folder / "g.json");
}

TEST(GatePlugin, RejectsACrashWithItsInputAndJudgesTheOthers) {
  const TemporaryFolder folder;
  const Finished finished = gate_of({"crash", "correct"},
                                    {"--sampler", "alias", "--density", "C", "--json", "g.json",
                                     "--junit", "g.xml", "--rejections", "rejected"},
                                    folder / "");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("check/every call returns"),
                                  HasSubstr("crashed (signal 11"), HasSubstr("at u = (0.700")));
  const nlohmann::json gate = json_of(folder / "g.json");
  EXPECT_THAT(values_of(gate, "sampler"),
              testing::UnorderedElementsAre("crash", "correct", "alias"));
  ASSERT_EQ(gate.at("rejections").size(), 1U);
  EXPECT_EQ(gate.at("rejections")[0].at("sampler"), "crash");
  EXPECT_EQ(gate.at("rejections")[0].at("looks_like"), "no answer");
  expect_valid("gate.schema.json", folder / "g.json");
  EXPECT_THAT(text_of(folder / "g.xml"), HasSubstr("at u = (0.700"));
}

TEST(GatePlugin, RejectsOneThatTakesTooLongOrTooMuch) {
  const Finished hanging = gate_of({"hang"});
  EXPECT_EQ(hanging.exit_code, 1);
  EXPECT_THAT(hanging.out, HasSubstr("sample() took longer than 1.5 s at u = (0.700"));
  if (!kHasOwnMemory) return;
  const Finished leaking = gate_of({"leak"}, {"--plugin-memory", "64M"});
  EXPECT_EQ(leaking.exit_code, 1);
  EXPECT_THAT(leaking.out, HasSubstr("may hold 64 MB"));
}

TEST(GatePlugin, ShowsWhatIsPrintedAsANoteAndKeepsItOutOfTheResults) {
  const Finished finished = gate_of({"prints"}, {"--json", "-"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(nlohmann::json::parse(finished.out).at("outcome"), "accept");
  EXPECT_THAT(finished.err, HasSubstr("prints: the plug-in printed: drew "));
  EXPECT_THAT(gate_of({"prints"}, {"-q"}).err, IsEmpty());
}

TEST(GatePlugin, RefusesWhatIsNoPlugin) {
  const TemporaryFolder folder;
  std::ofstream(folder / "notes.so") << "no library\n";
  for (const auto& [file, why] :
       {std::pair<std::string, const char*>{folder / "notes.so", "cannot be loaded"},
        {plugin("no-function"), "has no function"},
        {plugin("other-version"), "version 2 of the interface"},
        {plugin("crash-at-load"), "crashed (signal 6"},
        {folder / "nowhere.so", "there is no such file"}}) {
    const Finished finished = lightproof({"gate", "constant", "--size", "8x4", "--plugin", file});
    EXPECT_EQ(finished.exit_code, 2) << file;
    EXPECT_THAT(finished.err, AllOf(HasSubstr(file), HasSubstr(why)));
    EXPECT_EQ(finished.out, "");
  }
}

TEST(GatePlugin, RefusesTwoOfOneNameAndADensityThatItDoesNotDeclare) {
  const Finished twice = gate_of({"correct", "correct"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("two samplers of this run are called correct"));
  const Finished other = gate_of({"correct"}, {"--density", "A"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("correct declares density C, not A"));
  // What else is named has that density, and must not hide that the plug-in is not tested.
  const Finished beside = gate_of({"flipped-t"}, {"--sampler", "alias", "--density", "A"});
  EXPECT_EQ(beside.exit_code, 2);
  EXPECT_THAT(beside.err, HasSubstr("flipped-t declares density C, not A"));
  EXPECT_EQ(beside.out, "");
}

/// Builds what was written to a folder; its output if that fails.
std::string build(const Words& words, const fs::path& folder) {
  const Finished finished = run({.words = words, .folder = folder});
  return finished.exit_code == 0 ? "" : finished.out + finished.err;
}

void expect_works(const std::string& language, const std::vector<Words>& commands,
                  const std::string& library) {
  const TemporaryFolder folder;
  const Finished written = lightproof({"new-plugin", language, "my-light"}, folder / "");
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_THAT(written.out, HasSubstr("lightproof gate sun-sky --plugin my-light/" + library));
  for (const Words& words : commands) ASSERT_EQ(build(words, folder / "my-light"), "");
  const Finished judged = lightproof(
      {"gate", "sun-sky", "--size", "64x32", "-n", "262144", "--plugin", "my-light/" + library},
      folder / "");
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_THAT(judged.out, HasSubstr("my_light C"));
}

const std::vector<Words> kByCMake = {{LIGHTPROOF_CMAKE, "-B", "build", "-G", "Ninja"},
                                     {LIGHTPROOF_CMAKE, "--build", "build"}};

TEST(NewPlugin, InCBuildsAndIsAccepted) { expect_works("c", kByCMake, "build/libmy_light.so"); }

TEST(NewPlugin, InCppBuildsAndIsAccepted) { expect_works("c++", kByCMake, "build/libmy_light.so"); }

TEST(NewPlugin, InRustBuildsAndIsAccepted) {
  const std::string cargo = LIGHTPROOF_CARGO;
  if (cargo.empty()) GTEST_SKIP() << "there is no cargo";
  expect_works("rust", {{cargo, "build", "--release", "--offline"}},
               "target/release/libmy_light.so");
}

TEST(NewPlugin, WritesNothingIntoAFolderThatIsNotEmpty) {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine.txt") << "mine\n";
  const Finished finished = lightproof({"new-plugin", "c", folder / ""});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("the folder is not empty"));
  EXPECT_THAT(names_in(folder / ""), ElementsAre("mine.txt"));
}

TEST(NewPlugin, KnowsItsLanguages) {
  const TemporaryFolder folder;
  const Finished finished = lightproof({"new-plugin", "pascal", folder / "new"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "new"));
}

}  // namespace
}  // namespace lightproof::test
