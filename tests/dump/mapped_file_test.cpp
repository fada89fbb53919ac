#include "lightproof/dump/mapped_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "lightproof/core/temporary_folder.h"
#include "tests/dump/files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

/// Reads every byte.
int sum_of(const MappedFile& file) {
  int sum = 0;
  for (const std::byte byte : file.bytes()) sum += static_cast<int>(byte);
  return sum;
}

// The system has a signal for this (SIGBUS), which would end the program without a word.
TEST(MappedFile, ThatBecomesShorterIsNamed) {
  const TemporaryFolder folder;
  const fs::path path = folder / "samples.raw";
  test::write_bytes(path, std::string(1 << 20, '\1'));
  EXPECT_EXIT(
      {
        const MappedFile file(path);
        fs::resize_file(path, 4096);
        std::exit(sum_of(file) == 0 ? 1 : 0);
      },
      testing::ExitedWithCode(2), "samples.raw: has become shorter");
}

TEST(MappedFile, ThatBecomesShorterIsNamedWhateverOthersAreMapped) {
  const TemporaryFolder folder;
  const fs::path path = folder / "samples.raw";
  const fs::path other = folder / "other.raw";
  test::write_bytes(path, std::string(1 << 20, '\1'));
  test::write_bytes(other, std::string(1 << 20, '\1'));
  for (const bool is_open : {false, true}) {
    EXPECT_EXIT(
        {
          const MappedFile file(path);
          for (int i = 0; i < 100; ++i) const MappedFile before(other);
          const auto meanwhile = is_open ? std::make_unique<MappedFile>(other) : nullptr;
          fs::resize_file(path, 4096);
          std::exit(sum_of(file) == 0 ? 1 : 0);
        },
        testing::ExitedWithCode(2), "samples.raw: has become shorter");
    test::write_bytes(path, std::string(1 << 20, '\1'));
  }
}

TEST(MappedFile, ThatIsRemovedIsReadToItsEnd) {
  const TemporaryFolder folder;
  const fs::path path = folder / "samples.raw";
  test::write_bytes(path, std::string(1 << 20, '\1'));
  const MappedFile file(path);
  fs::remove(path);
  EXPECT_EQ(sum_of(file), 1 << 20);
}

}  // namespace
}  // namespace lightproof
