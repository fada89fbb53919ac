// lightproof study: what it refuses, at once and without touching anything.
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

/// Long enough that a study which starts its work instead is noticed.
constexpr double kAtOnce = 5.0;

class StudyRefuses : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }

  /// Runs in the folder of the test, on the built-in map, without throughput.
  Finished study(const Words& more) const {
    Words words = {"study", "constant", "--size", "32x16", "--no-throughput"};
    words.insert(words.end(), more.begin(), more.end());
    return Process(lightproof_command(words, path(""))).wait(std::chrono::seconds(30));
  }

  static void expect_refused(const Finished& study, const testing::Matcher<std::string>& message) {
    EXPECT_EQ(study.exit_code, 2);
    EXPECT_THAT(study.out, IsEmpty());
    EXPECT_THAT(study.err, AllOf(StartsWith("lightproof: "), message));
    EXPECT_LT(study.seconds, kAtOnce);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(StudyRefuses, AFolderThatHoldsSomething) {
  for (const char* folder : {"out", "other"}) {
    fs::create_directory(path(folder));
    write_bytes(path(folder) / "notes.txt", "mine");
    const Words where = folder == std::string("out") ? Words{} : Words{"-o", folder};
    expect_refused(study(where),
                   AllOf(HasSubstr(folder), HasSubstr("--force"), HasSubstr("This would go on: "),
                         HasSubstr("study constant")));
    EXPECT_THAT(names_in(path(folder)), ElementsAre("notes.txt"));
  }
}

TEST_F(StudyRefuses, ToReplaceWhatNoManifestListsEvenIfForced) {
  fs::create_directory(path("out"));
  write_bytes(path("out/report.html"), "mine");
  expect_refused(study({}), Not(HasSubstr("This would go on")));
  expect_refused(study({"--force"}), AllOf(HasSubstr("report.html"), HasSubstr("manifest")));
  EXPECT_EQ(bytes_of(path("out/report.html")), "mine");
}

TEST_F(StudyRefuses, AManifestThatNamesFilesElsewhere) {
  fs::create_directory(path("out"));
  write_bytes(path("mine"), "mine");
  write_bytes(path("out/manifest.json"),
              R"({"format": "lightproof manifest", "files": ["../mine"]})");
  expect_refused(study({"--force"}), AllOf(HasSubstr("'../mine'"), HasSubstr("no plain name")));
  EXPECT_EQ(bytes_of(path("mine")), "mine");
}

TEST_F(StudyRefuses, AFileForAFolder) {
  write_bytes(path("file"), "mine");
  expect_refused(study({"-o", "file"}), AllOf(HasSubstr("file"), HasSubstr("not a folder")));
  EXPECT_EQ(bytes_of(path("file")), "mine");
}

TEST_F(StudyRefuses, AFolderBelowAFile) {
  write_bytes(path("file"), "mine");
  expect_refused(study({"-o", "file/below"}), HasSubstr("file/below"));
}

TEST_F(StudyRefuses, MissingMapsWithoutLeavingAFolder) {
  const Finished refused = lightproof({"study", "none.exr", "--no-throughput"}, path(""));
  expect_refused(refused, HasSubstr("none.exr"));
  EXPECT_THAT(names_in(path("")), IsEmpty());
}

TEST_F(StudyRefuses, AThroughputFileThatIsNotThereBeforeItsWork) {
  Process study(lightproof_command(
      {"study", "constant", "--size", "32x16", "-o", "o", "--throughput", "none.json"}, path("")));
  expect_refused(study.wait(std::chrono::seconds(30)), HasSubstr("none.json"));
}

TEST_F(StudyRefuses, AReadOnlyFolder) {
  if (!has_mount_namespaces()) GTEST_SKIP() << "mount namespaces are not available here";
  fs::create_directory(path("sealed"));
  const Finished refused = run(in_mount_namespace(
      "mount -t tmpfs -o ro none sealed && \"$@\"",
      {"study", "constant", "--size", "32x16", "--no-throughput", "-o", "sealed"}, path("")));
  expect_refused(refused, AllOf(HasSubstr("sealed"), HasSubstr("Read-only file system")));
}

}  // namespace
}  // namespace lightproof::test
