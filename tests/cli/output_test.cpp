// Where results cannot be written: said with the file and the reason, and nothing is left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

class Output : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

TEST_F(Output, InAMissingFolderIsRefused) {
  const Finished gate = quick_gate({"constant", "--json", path("none/g.json")});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, AllOf(StartsWith("lightproof: "), HasSubstr("none/g.json"),
                              HasSubstr("No such file or directory")));
  EXPECT_THAT(names_in(path("")), IsEmpty());
}

TEST_F(Output, OverAFolderIsRefused) {
  fs::create_directory(path("g.json"));
  const Finished gate = quick_gate({"constant", "--json", path("g.json")});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, AllOf(HasSubstr("g.json"), HasSubstr("Is a directory")));
  EXPECT_THAT(names_in(path("")), ElementsAre("g.json"));
}

TEST_F(Output, IsTriedBeforeMinutesAreSpent) {
  Process gate(lightproof_command({"gate", "--json", path("none/g.json"), "-n", "1073741824"}));
  EXPECT_EQ(gate.wait(std::chrono::seconds(20)).exit_code, 2);
}

TEST_F(Output, ReplacesAnEarlierFileWhole) {
  write_bytes(path("g.json"), "earlier");
  EXPECT_EQ(quick_gate({"constant", "-q", "--json", path("g.json")}).exit_code, 0);
  EXPECT_EQ(json_of(path("g.json")).at("outcome"), "accept");
  EXPECT_THAT(names_in(path("")), ElementsAre("g.json"));
}

// Renaming over a device or a link would replace it: for root, that is /dev/null or /dev/stdout.
TEST_F(Output, IntoALinkLeavesTheLinkAlone) {
  write_bytes(path("target.json"), "earlier");
  fs::create_symlink("target.json", path("link.json"));
  EXPECT_EQ(quick_gate({"constant", "-q", "--json", path("link.json")}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.json")));
  EXPECT_EQ(json_of(path("target.json")).at("outcome"), "accept");
}

TEST_F(Output, IntoAPipeDoesNotReplaceIt) {
  const char* const script =
      R"(mkfifo pipe; cat pipe > copy & "$@"; test -p pipe || { kill $!; exit 9; }; wait)";
  Command command{.words = {"sh", "-c", script, "sh", program()}, .folder = path("")};
  for (const char* word : {"gate", "constant", "-n", "1024", "--must-detect", "10", "--size", "8x4",
                           "--json", "pipe"}) {
    command.words.emplace_back(word);
  }
  EXPECT_EQ(run(command).exit_code, 0);
  EXPECT_EQ(json_of(path("copy")).at("outcome"), "accept");
}

TEST_F(Output, OnStdoutThatCannotBeWrittenIsNotAPass) {
  // The last one is more than is kept back until the end.
  for (const std::string words : {"gate constant -n 1024 --must-detect 10 --size 8x4",
                                  "list samplers", "gate -n 1024 --must-detect 10 --size 8x4"}) {
    const Finished finished =
        run({.words = {"sh", "-c", "exec \"$0\" " + words + " > /dev/full", program()}});
    EXPECT_EQ(finished.exit_code, 2) << words;
    EXPECT_THAT(finished.err,
                AllOf(HasSubstr("standard output"), HasSubstr("No space left on device")))
        << words;
  }
}

TEST_F(Output, ToADashIsTheStandardOutputAlone) {
  for (const char* option : {"--json", "--junit", "--markdown"}) {
    const Finished gate = quick_gate({"constant", "--github", option, "-"}, path(""));
    EXPECT_NE(gate.exit_code, 2) << gate.err;
    EXPECT_THAT(gate.out, StartsWith(option == std::string("--json")    ? "{\n"
                                     : option == std::string("--junit") ? "<?xml"
                                                                        : "### "));
    EXPECT_THAT(gate.out, Not(HasSubstr("worst test")));
    EXPECT_THAT(gate.err, HasSubstr("worst test")) << "the table is for people";
    EXPECT_THAT(names_in(path("")), IsEmpty());
  }
  const Finished quiet = quick_gate({"constant", "-q", "--json", "-"}, path(""));
  EXPECT_THAT(quiet.err, IsEmpty());
  EXPECT_FALSE(nlohmann::json::parse(quiet.out).at("tests").empty());
}

TEST_F(Output, OfTwoKindsDoesNotFitOneStandardOutput) {
  const Finished gate = quick_gate({"constant", "--json", "-", "--junit", "-"});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.out, IsEmpty());
}

TEST_F(Output, IntoAFolderOrFromAFileIsNoStandardStream) {
  for (const Words& words :
       {Words{"gate", "constant", "--rejections", "-"}, Words{"study", "constant", "-o", "-"},
        Words{"study", "constant", "--throughput", "-"},
        Words{"history", "trend", "--db", "-", "-o", "t.html"}}) {
    const Finished finished = lightproof(words, path(""));
    EXPECT_EQ(finished.exit_code, 2) << words[0];
    EXPECT_THAT(finished.err, HasSubstr("./-")) << words[0];
    EXPECT_THAT(names_in(path("")), IsEmpty());
  }
}

class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_mount_namespaces()) GTEST_SKIP() << "mount namespaces are not available here";
  }
};

// All maps and samplers make some 200 kB of JSON.
TEST_F(FullDisk, NamesFileAndReasonAndKeepsTheEarlierFile) {
  const TemporaryFolder folder;
  const std::string script =
      "mount -t tmpfs -o size=64k none . && cd \"$PWD\" && echo earlier > g.json && "
      "\"$@\" --json g.json; code=$?; ls -A; cat g.json; exit $code";
  const Finished gate = run(in_mount_namespace(
      script, {"gate", "-q", "-n", "1024", "--must-detect", "10", "--size", "8x4"}, folder / ""));
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, AllOf(StartsWith("lightproof: "), HasSubstr("g.json"),
                              HasSubstr("No space left on device")));
  EXPECT_EQ(gate.out, "g.json\nearlier\n");
}

TEST_F(FullDisk, ReadOnlyFolderIsNamedBeforeTheGateRuns) {
  const TemporaryFolder folder;
  const std::string script =
      "mount -t tmpfs -o ro none . && cd \"$PWD\" && \"$@\"; code=$?; ls -A; exit $code";
  Process gate(in_mount_namespace(script, {"gate", "-q", "-n", "1073741824", "--json", "g.json"},
                                  folder / ""));
  const Finished finished = gate.wait(std::chrono::seconds(20));
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("g.json"), HasSubstr("Read-only file system")));
  EXPECT_THAT(finished.out, IsEmpty());
}

}  // namespace
}  // namespace lightproof::test
