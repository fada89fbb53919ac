#include "lightproof/report/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void put(const fs::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary) << content;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Results : public ::testing::Test {
 protected:
  fs::path folder() const { return root_ / "results"; }
  fs::path file(std::string_view name) const { return folder() / name; }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder())) {
      all.insert(entry.path().filename().string());
    }
    return all;
  }

  /// A run that writes these files, each with `content`.
  void write(const std::set<std::string>& files, std::string_view content,
             Overwriting overwriting = Overwriting::of_listed_files) const {
    ResultFolder results(folder(), overwriting);
    for (const std::string& name : files) put(results.temporary() / name, content);
    results.commit({"0.1.0", "", "lightproof study"});
  }

  /// The message with which a run that writes report.html is refused at its start; empty if not.
  std::string refusal(Overwriting overwriting) const {
    try {
      check_result_folder(folder(), overwriting, {"report.html"});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  void write_manifest(std::string_view files) const {
    fs::create_directories(folder());
    put(file("manifest.json"),
        std::string(R"({"format": "lightproof manifest", "files": )") + std::string(files) + "}");
  }

 private:
  TemporaryFolder root_;
};

TEST_F(Results, GoIntoANewOrEmptyFolder) {
  EXPECT_EQ(refusal(Overwriting::refused), "");
  EXPECT_TRUE(fs::is_directory(folder()));
  write({"report.html"}, "first", Overwriting::refused);
  EXPECT_THAT(names(), ElementsAre("manifest.json", "report.html"));
  EXPECT_THAT(listed_files(folder()), ElementsAre("manifest.json", "report.html"));
}

TEST_F(Results, DoNotGoIntoAFolderThatHoldsSomething) {
  fs::create_directories(folder());
  put(file("notes.txt"), "mine");
  EXPECT_THAT(refusal(Overwriting::refused), AllOf(HasSubstr("holds files"), HasSubstr("--force")));
  EXPECT_EQ(refusal(Overwriting::of_listed_files), "");
}

TEST_F(Results, ReplaceThoseOfAnEarlierRunAndNothingElse) {
  write({"report.html", "old-map.exr"}, "first");
  put(file("notes.txt"), "mine");
  write({"report.html", "new-map.exr"}, "second");
  EXPECT_THAT(names(), ElementsAre("manifest.json", "new-map.exr", "notes.txt", "report.html"));
  EXPECT_EQ(content_of(file("report.html")), "second");
  EXPECT_EQ(content_of(file("notes.txt")), "mine");
}

TEST_F(Results, LeaveAFileOfTheirNameThatNoManifestLists) {
  fs::create_directories(folder());
  put(file("report.html"), "mine");
  EXPECT_THAT(refusal(Overwriting::of_listed_files),
              AllOf(HasSubstr("report.html"), HasSubstr("does not list it")));
  EXPECT_THROW(write({"report.html"}, "new"), InputError);
  EXPECT_EQ(content_of(file("report.html")), "mine");
  EXPECT_THAT(names(), ElementsAre("report.html"));
}

TEST_F(Results, LeaveTheEarlierRunWholeIfAFileStandsInTheirWay) {
  write({"report.html"}, "first");
  put(file("picture.exr"), "mine");
  EXPECT_THROW(write({"report.html", "picture.exr"}, "second"), InputError);
  EXPECT_EQ(content_of(file("report.html")), "first");
  EXPECT_THAT(names(), ElementsAre("manifest.json", "picture.exr", "report.html"));
}

// Whoever writes a manifest must not choose what is removed elsewhere.
TEST_F(Results, RefuseAManifestThatNamesFilesOutsideOfItsFolder) {
  for (const char* files : {R"(["../mine"])", R"(["/etc/passwd"])", R"([".."])", R"(["."])",
                            R"([""])", R"(["below/mine"])", "[7]", R"(["a\u0000b"])"}) {
    write_manifest(files);
    EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("manifest.json: lists")) << files;
    EXPECT_THROW(write({"report.html"}, "new"), InputError) << files;
    EXPECT_THAT(names(), ElementsAre("manifest.json")) << files;
  }
}

TEST_F(Results, RefuseAManifestThatListsAFolder) {
  write_manifest(R"(["below"])");
  fs::create_directory(file("below"));
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("'below', which is a folder"));
}

TEST_F(Results, RefuseTheManifestOfAnotherProgram) {
  fs::create_directories(folder());
  for (const char* text : {"", "{", "[]", R"({"name": "web app"})", R"({"files": ["a"]})",
                           R"({"format": "lightproof manifest"})",
                           R"({"format": "lightproof manifest", "files": 7})"}) {
    put(file("manifest.json"), text);
    EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("is no manifest")) << text;
    EXPECT_EQ(content_of(file("manifest.json")), text);
  }
}

TEST_F(Results, RemoveALinkAndNotWhatItLeadsTo) {
  write({"report.html", "old.exr"}, "first");
  put(folder().parent_path() / "mine", "mine");
  fs::remove(file("old.exr"));
  fs::create_symlink("../mine", file("old.exr"));
  write({"report.html"}, "second");
  EXPECT_THAT(names(), ElementsAre("manifest.json", "report.html"));
  EXPECT_EQ(content_of(folder().parent_path() / "mine"), "mine");
}

TEST_F(Results, OfARunThatWasStoppedWhileItMovedThemCanBeReplaced) {
  write({"report.html", "old.exr"}, "first");
  write_manifest(R"(["report.html", "old.exr", "new.exr"])");  // as commit() leaves it then
  write({"report.html"}, "third");
  EXPECT_THAT(names(), ElementsAre("manifest.json", "report.html"));
}

// What a run that was killed leaves: parts of files, its unfinished work, a manifest that says so.
TEST_F(Results, GoWhereAKilledRunLeftNoResults) {
  fs::create_directories(file(".77.part"));
  put(file(".77.part") / "report.html", "half");
  put(file(".manifest.77.part.json"), "{");
  fs::create_directories(file("unfinished"));
  EXPECT_EQ(refusal(Overwriting::refused), "");
  EXPECT_THAT(names(), ElementsAre("unfinished"));
  put(file("unfinished") / "novel.txt", "mine");
  EXPECT_THAT(refusal(Overwriting::refused), HasSubstr("holds files already"));
}

TEST_F(Results, OfTwoRunsAtOnceAreThoseOfTheFirst) {
  const ResultFolder first(folder(), Overwriting::refused);
  EXPECT_THAT(refusal(Overwriting::refused), HasSubstr("another run"));
  EXPECT_THROW(ResultFolder(folder(), Overwriting::refused), InputError);
}

TEST_F(Results, GoNowhereIfTheFolderIsAFile) {
  put(folder(), "mine");
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("not a folder"));
  EXPECT_THAT(refusal(Overwriting::refused), HasSubstr("not a folder"));
}

TEST_F(Results, RefuseAManifestThatLiesTooDeepInItself) {
  fs::create_directories(folder());
  put(file("manifest.json"), std::string(1'000'000, '['));
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("is no manifest"));
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  put(file("manifest.json"), R"({"format": )" + deep + "}");
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("is no manifest"));
}

// What cannot be looked at could not be removed in the end.
TEST_F(Results, RefuseAManifestThatListsANameThatIsTooLong) {
  write_manifest("[\"" + std::string(300, 'x') + "\"]");
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("xxx', which cannot be looked at"));
}

TEST_F(Results, RefuseAManifestThatIsAFolder) {
  fs::create_directories(file("manifest.json"));
  EXPECT_THAT(refusal(Overwriting::of_listed_files), HasSubstr("is no manifest"));
}

}  // namespace
}  // namespace lightproof
