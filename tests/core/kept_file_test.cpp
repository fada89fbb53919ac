#include "lightproof/core/kept_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  return {fs::directory_iterator(folder), {}};
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string kContent("some\0content\n", 13);

TEST(KeptFile, GivesBackWhatWasKeptUnderTheSameNameAndIdentity) {
  const TemporaryFolder folder;
  const KeptFile file = {folder / "new/folder", "result", "of this"};
  EXPECT_EQ(read_kept(file), std::nullopt);
  EXPECT_TRUE(keep(file, kContent));
  EXPECT_EQ(read_kept(file), kContent);
  EXPECT_TRUE(keep(file, "other"));
  EXPECT_EQ(read_kept(file), "other") << "replaced";
  EXPECT_EQ(files_in(file.folder).size(), 1U);
  EXPECT_EQ(read_kept({file.folder, "result", "of that"}), std::nullopt);
  EXPECT_EQ(read_kept({file.folder, "finding", "of this"}), std::nullopt);
}

// Whichever byte is damaged, and wherever the file is cut off.
TEST(KeptFile, IsNoneIfItIsDamaged) {
  const TemporaryFolder folder;
  const KeptFile file = {folder / "cache", "result", "of this"};
  keep(file, kContent);
  const fs::path path = files_in(file.folder)[0];
  const std::string whole = bytes_of(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_EQ(read_kept(file), std::nullopt) << "byte " << i;
    std::ofstream(path, std::ios::binary) << whole.substr(0, i);
    EXPECT_EQ(read_kept(file), std::nullopt) << i << " bytes";
  }
  std::ofstream(path, std::ios::binary) << whole << '\0';
  EXPECT_EQ(read_kept(file), std::nullopt) << "a byte too many";
  std::ofstream(path, std::ios::binary) << whole;
  EXPECT_EQ(read_kept(file), kContent);
}

// Two identities may have one hash, and so one file.
TEST(KeptFile, OfAnotherIdentityUnderItsNameIsNone) {
  const TemporaryFolder folder;
  const KeptFile mine = {folder / "mine", "result", "of this"};
  const KeptFile foreign = {folder / "foreign", "result", "of that"};
  keep(mine, "mine");
  keep(foreign, "foreign");
  fs::copy_file(files_in(foreign.folder)[0], files_in(mine.folder)[0],
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(read_kept(mine), std::nullopt);
}

TEST(KeptFile, NeedsAFolderThatCanBeWrittenTo) {
  const TemporaryFolder folder;
  EXPECT_FALSE(keep({"", "result", "of this"}, kContent));
  EXPECT_EQ(read_kept({"", "result", "of this"}), std::nullopt);
  EXPECT_FALSE(keep({"/proc/no/such/place", "result", "of this"}, kContent));
  const KeptFile file = {folder / "cache", "result", "of this"};
  keep(file, kContent);
  const fs::path path = files_in(file.folder)[0];
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_EQ(read_kept(file), std::nullopt) << "a folder of its name";
  EXPECT_FALSE(keep(file, kContent));
}

TEST(HashOfFile, TellsContentsApart) {
  const TemporaryFolder folder;
  std::ofstream(folder / "one") << kContent;
  std::ofstream(folder / "same") << kContent;
  std::ofstream(folder / "other") << kContent << ' ';
  EXPECT_EQ(hash_of_file(folder / "one"), hash_of_file(folder / "same"));
  EXPECT_NE(hash_of_file(folder / "one"), hash_of_file(folder / "other"));
  EXPECT_EQ(hash_of_file(folder / "none"), std::nullopt);
  EXPECT_EQ(hash_of_file("/proc"), std::nullopt);
}

}  // namespace
}  // namespace lightproof
