#include "lightproof/core/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& path, std::string_view content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// A folder of its own for every test, gone afterwards.
class AtomicFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "/lightproof-XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path in_folder(std::string_view name) const { return folder_ / name; }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

 private:
  fs::path folder_;
};

/// The message of the InputError that write_file throws; empty if it throws none.
std::string refusal(const fs::path& path, std::string_view content) {
  try {
    write_file(path, content);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(AtomicFiles, WriteFileWritesEveryByte) {
  const std::string content("line\r\n\0\xff end", 12);
  write_file(in_folder("new.json"), content);
  EXPECT_EQ(content_of(in_folder("new.json")), content);
  write_file(in_folder("empty"), "");
  EXPECT_EQ(fs::file_size(in_folder("empty")), 0U);
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFiles, WriteFileReplacesALongerFile) {
  put(in_folder("a.txt"), "what stood here before, and was longer");
  write_file(in_folder("a.txt"), "new");
  EXPECT_EQ(content_of(in_folder("a.txt")), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, WriteFileTakesARelativePath) {
  const fs::path before = fs::current_path();
  fs::current_path(in_folder(""));
  EXPECT_NO_THROW(write_file("plain.txt", "here"));
  fs::current_path(before);
  EXPECT_EQ(content_of(in_folder("plain.txt")), "here");
}

TEST_F(AtomicFiles, NothingChangesBeforeTheCommit) {
  const fs::path target = in_folder("image.exr");
  put(target, "old");
  // Someone who has the old file open keeps it whole: it is replaced, not overwritten.
  std::ifstream reader(target, std::ios::binary);
  AtomicFile pending(target);
  put(pending.temporary(), "new");
  EXPECT_EQ(content_of(target), "old");
  pending.commit();
  EXPECT_EQ(content_of(target), "new");
  EXPECT_FALSE(fs::exists(pending.temporary()));
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>(reader), {}}), "old");
}

TEST_F(AtomicFiles, TemporaryStandsBesideTheTargetWithItsExtension) {
  const AtomicFile pending(in_folder("image.exr"));
  EXPECT_EQ(pending.temporary().extension(), ".exr");
  EXPECT_EQ(pending.temporary().parent_path(), in_folder("image.exr").parent_path());
  EXPECT_NE(pending.temporary(), in_folder("image.exr"));
}

TEST_F(AtomicFiles, PartsAreToldFromFilesOfTheUser) {
  for (const char* part : {".77.part", ".g.77.part.json", ".a.b.77.part.exr", ".h.db.77.part"}) {
    EXPECT_TRUE(is_part(part)) << part;
  }
  for (const char* other : {"77.part", ".part", "..part", ".x.part", ".77.parts", ".77.part7",
                            "film.77.part", ".77", ""}) {
    EXPECT_FALSE(is_part(other)) << other;
  }
  const AtomicFile file(in_folder("g.json"));
  EXPECT_TRUE(is_part(file.temporary().filename().string()));
  const AtomicFolder folder(in_folder("made"));
  EXPECT_TRUE(is_part(folder.temporary().filename().string()));
}

TEST_F(AtomicFiles, FolderLosesThePartsOfProcessesThatWereKilled) {
  fs::create_directories(in_folder("made/.77.part"));
  put(in_folder("made/.77.part/half.exr"), "ha");
  put(in_folder("made/.manifest.77.part.json"), "{");
  put(in_folder("made/mine.part"), "mine");
  {
    const AtomicFolder folder(in_folder("made"));
    EXPECT_THROW(AtomicFolder(in_folder("made")), InputError) << "it is not alone";
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(in_folder("made")), fs::directory_iterator()), 1);
  EXPECT_EQ(content_of(in_folder("made/mine.part")), "mine");
}

TEST_F(AtomicFiles, AbandonedFileLeavesTheOldOne) {
  put(in_folder("a.txt"), "old");
  {
    const AtomicFile pending(in_folder("a.txt"));
    put(pending.temporary(), "half of the n");
    EXPECT_EQ(files(), 2);
  }
  EXPECT_EQ(content_of(in_folder("a.txt")), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, AbandonedFileLeavesNothingWhereNothingWas) {
  { const AtomicFile pending(in_folder("a.txt")); }
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFiles, MissingFolderIsNamed) {
  const fs::path target = in_folder("missing") / "a.txt";
  const std::string message = refusal(target, "x");
  EXPECT_THAT(message, HasSubstr(target.string()));
  EXPECT_THAT(message, HasSubstr("No such file or directory"));
  EXPECT_THROW(AtomicFile{target}, InputError) << "before anything is computed for it";
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFiles, FileInPlaceOfTheFolderIsNamed) {
  put(in_folder("file"), "x");
  EXPECT_THAT(refusal(in_folder("file") / "a.txt", "x"), HasSubstr("Not a directory"));
}

TEST_F(AtomicFiles, FolderInPlaceOfTheFileIsRefusedAndLeft) {
  fs::create_directory(in_folder("taken"));
  EXPECT_THAT(refusal(in_folder("taken"), "x"), HasSubstr(in_folder("taken").string()));
  EXPECT_TRUE(fs::is_directory(in_folder("taken")));
  EXPECT_EQ(files(), 1) << "the temporary file is left behind";
}

TEST_F(AtomicFiles, FullDiskIsReportedAndLeavesTheOldFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const fs::path target = in_folder("a.txt");
  put(target, "old");
  // The next temporary file of this target lands on the device that is always full.
  const fs::path temporary = AtomicFile(target).temporary();
  if (AtomicFile(target).temporary() != temporary) GTEST_SKIP() << "temporary names are fresh";
  fs::create_symlink("/dev/full", temporary);
  const std::string message = refusal(target, "new");
  EXPECT_THAT(message, HasSubstr(target.string()));
  EXPECT_THAT(message, HasSubstr("No space left on device"));
  EXPECT_EQ(content_of(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, WriteThatFailsHalfWayLeavesTheOldFile) {
  const fs::path target = in_folder("a.txt");
  put(target, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal(target, std::string(1 << 20, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr(target.string() + ": cannot write: "));
  EXPECT_EQ(content_of(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, WriteFileFollowsALink) {
  put(in_folder("real.txt"), "old");
  fs::create_symlink("real.txt", in_folder("link.txt"));
  write_file(in_folder("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(in_folder("link.txt")));
  EXPECT_EQ(content_of(in_folder("real.txt")), "new");
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFiles, WriteFileReplacesALinkThatLeadsNowhere) {
  fs::create_symlink("missing.txt", in_folder("link.txt"));
  write_file(in_folder("link.txt"), "new");
  EXPECT_EQ(content_of(in_folder("link.txt")), "new");
}

TEST_F(AtomicFiles, WriteFileWritesIntoAPipe) {
  const fs::path pipe = in_folder("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  write_file(pipe, "through");
  std::string received(64, ' ');
  received.resize(static_cast<std::size_t>(
      std::max<ssize_t>(0, ::read(reader, received.data(), received.size()))));
  ::close(reader);
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, CheckWritableLeavesEverythingAsItIs) {
  put(in_folder("a.txt"), "old");
  EXPECT_NO_THROW(check_writable(in_folder("a.txt")));
  EXPECT_NO_THROW(check_writable(in_folder("new.txt")));
  EXPECT_EQ(content_of(in_folder("a.txt")), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, CheckWritableRefusesWhatCannotBeWritten) {
  const fs::path missing = in_folder("missing") / "a.txt";
  try {
    check_writable(missing);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(missing.string()));
  }
  EXPECT_THROW(check_writable(in_folder("")), InputError) << "a folder";
}

TEST_F(AtomicFiles, ANameTooLongIsBadInput) {
  const fs::path file = in_folder(std::string(300, 'x'));
  EXPECT_THROW(check_writable(file), InputError);
  EXPECT_THROW(write_file(file, "x"), InputError);
}

TEST_F(AtomicFiles, AFolderThatHasGoneIsNamed) {
  const fs::path target = in_folder("report");
  AtomicFolder pending(target);
  fs::remove_all(target);
  try {
    pending.commit();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(target.string()));
  }
}

TEST_F(AtomicFiles, AFolderAppearsWithAllItsFilesOrNotAtAll) {
  const fs::path target = in_folder("report");
  {
    const AtomicFolder pending(target);
    put(pending.temporary() / "a.txt", "new");
  }
  EXPECT_TRUE(!fs::exists(target) || fs::is_empty(target));
  put(target / "a.txt", "old");
  put(target / "kept.txt", "kept");
  {
    AtomicFolder pending(target);
    put(pending.temporary() / "a.txt", "new");
    put(pending.temporary() / "b.txt", "more");
    EXPECT_EQ(content_of(target / "a.txt"), "old");
    pending.commit();
  }
  EXPECT_EQ(content_of(target / "a.txt"), "new");
  EXPECT_EQ(content_of(target / "b.txt"), "more");
  EXPECT_EQ(content_of(target / "kept.txt"), "kept");
  EXPECT_EQ(std::distance(fs::directory_iterator(target), fs::directory_iterator()), 3);
}

TEST_F(AtomicFiles, AFolderThatIsAFileIsNamed) {
  put(in_folder("report"), "a file");
  EXPECT_THROW(AtomicFolder{in_folder("report")}, InputError);
}

}  // namespace
}  // namespace lightproof
