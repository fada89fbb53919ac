// The program without its decoder, and with one where an installation has it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class InstalledProgram : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "prefix/bin");
    fs::copy_file(program(), folder_ / "prefix/bin/lightproof");
    write_map(folder_ / "a.exr");
  }

  Finished installed(const Words& words) const {
    Command command = lightproof_command(words);
    command.words[0] = (folder_ / "prefix/bin/lightproof").string();
    return run(command);
  }

  TemporaryFolder folder_;
};

TEST_F(InstalledProgram, SaysThatItsDecoderIsMissingWhereItNeedsIt) {
  EXPECT_EQ(installed({"--version"}).exit_code, 0);
  EXPECT_EQ(installed({"info", "constant"}).exit_code, 0);
  const Finished info = installed({"info", (folder_ / "a.exr").string()});
  EXPECT_EQ(info.exit_code, 2);
  EXPECT_THAT(info.err, AllOf(HasSubstr("is missing"), HasSubstr("LIGHTPROOF_DECODER"),
                              HasSubstr("prefix/libexec/lightproof/lightproof-decode")));
}

TEST_F(InstalledProgram, FindsItsDecoderBelowItsPrefix) {
  fs::create_directories(folder_ / "prefix/libexec/lightproof");
  fs::copy_file(fs::path(program()).parent_path() / "lightproof-decode",
                folder_ / "prefix/libexec/lightproof/lightproof-decode");
  const Finished info = installed({"info", (folder_ / "a.exr").string()});
  EXPECT_EQ(info.exit_code, 0) << info.err;
}

TEST(Program, StartsWithoutLibrariesOfPictures) {
  const Finished ldd = run({.words = {"ldd", program()}});
  for (const char* library : {"OpenImageIO", "OpenEXR", "Imath", "libpng", "libjpeg", "libtiff"}) {
    EXPECT_THAT(ldd.out, testing::Not(HasSubstr(library)));
  }
}

}  // namespace
}  // namespace lightproof::test
