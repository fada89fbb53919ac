#include "lightproof/core/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

/// The message of the InputError that a shell running this script ends in; empty if it ends well.
std::string failure_of(const std::string& script) {
  try {
    run_child("/bin/sh", {"-c", script});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunChild, PassesItsArgumentsAndWaits) {
  const TemporaryFolder folder;
  const auto file = folder / "two words";
  run_child("/bin/sh", {"-c", "sleep 0.1; echo \"$1\" > \"$0\"", file.string(), "a 'b'"});
  std::string line;
  std::getline(std::ifstream(file), line);
  EXPECT_EQ(line, "a 'b'");
}

TEST(RunChild, SaysHowTheProgramEndedAndItsLastWords) {
  EXPECT_EQ(failure_of("exit 0"), "");
  EXPECT_THAT(failure_of("exit 7"), testing::AllOf(HasSubstr("/bin/sh"), HasSubstr("7")));
  EXPECT_THAT(failure_of("echo first >&2; echo 'no such map' >&2; exit 2"),
              testing::AllOf(HasSubstr("no such map"), testing::Not(HasSubstr("first"))));
  EXPECT_THAT(failure_of("kill -9 $$"), HasSubstr("9"));
}

TEST(RunChild, NamesAProgramThatIsNotThere) {
  EXPECT_THROW(run_child("/nowhere/lightproof_bench", {}), InputError);
}

TEST(TemporaryFolder, GoesAwayWithWhatIsInIt) {
  std::filesystem::path inside;
  {
    const TemporaryFolder folder;
    inside = folder / "sub";
    std::filesystem::create_directory(inside);
    std::ofstream(inside / "file") << "x";
    EXPECT_TRUE(std::filesystem::exists(inside / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(inside.parent_path()));
}

}  // namespace
}  // namespace lightproof
