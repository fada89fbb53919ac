// Lack of memory: exit code 71, and for which map.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int kOutOfMemory = 71;

/// The program in so many megabytes of addresses.
Finished within(int megabytes, const Words& arguments, const std::filesystem::path& folder) {
  const std::string script = fmt::format("ulimit -v {}; exec \"$@\"", 1024 * megabytes);
  Command command{.words = {"sh", "-c", script, "sh", program()}, .folder = folder};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  return run(command);
}

class Memory : public testing::Test {
 protected:
  void SetUp() override {
    if (!kHasOwnMemory) GTEST_SKIP() << "a sanitizer cannot be limited";
  }
  TemporaryFolder folder_;
};

// 16384 x 8192 texels of 12 bytes are 1.6 GB.
TEST_F(Memory, ThatAMapDoesNotFitIntoIsNamed) {
  const Finished gate = within(
      1400, {"gate", "sun-sky", "--size", "16384x8192", "--json", "gate.json"}, folder_ / "");
  EXPECT_EQ(gate.exit_code, kOutOfMemory) << gate.err;
  EXPECT_THAT(gate.out, IsEmpty());
  EXPECT_THAT(gate.err, AllOf(HasSubstr("not enough memory"), HasSubstr("sun-sky (16384x8192)"),
                              HasSubstr("1.61 GB"), Not(HasSubstr("internal error"))));
  EXPECT_THAT(names_in(folder_ / ""), IsEmpty());
}

// 8192 x 4096 texels of 12 bytes are 0.4 GB, and a number a texel is 0.27 GB, of which the gate
// needs two at once while it finds their distribution.
TEST_F(Memory, ThatTheDistributionOfAMapDoesNotFitIntoIsNamed) {
  const Finished gate = within(
      800, {"gate", "constant", "--size", "8192x4096", "-n", "1024", "-t", "1"}, folder_ / "");
  EXPECT_EQ(gate.exit_code, kOutOfMemory) << gate.err;
  EXPECT_THAT(gate.err, HasSubstr("distribution of constant (8192x4096)"));
}

TEST_F(Memory, ThatABenchmarkDoesNotFitIntoIsLacking) {
  const std::filesystem::path bench =
      std::filesystem::path(program()).parent_path() / "lightproof_bench";
  if (!std::filesystem::exists(bench)) GTEST_SKIP() << "the benchmarks were not built";
  Command command{.words = {"sh", "-c", "ulimit -v 700000; exec \"$@\"", "sh", bench.string(),
                            "--benchmark_filter=^sample/alias/sun-sky/8192x4096/batch$"},
                  .folder = folder_ / ""};
  const Finished finished = run(command);
  EXPECT_EQ(finished.exit_code, kOutOfMemory) << finished.err;
  EXPECT_THAT(finished.err, HasSubstr("not enough memory"));
}

// A hundred maps of 256 x 128 texels fill what a run keeps of maps. A hundred more are 39 MB of
// texels, and with what is drawn and computed for each of them 170 MB.
TEST_F(Memory, OfManyMapsGrowsByLessThanTheirTexels) {
  const std::string file = (folder_ / "sky.exr").string();
  write_map(file, {256, 128});
  const auto peak_of = [&](std::size_t maps) {
    Words words = {"gate", "-n", "1024", "--sampler", "alias", "--density", "A", "-q"};
    words.insert(words.end(), maps, file);
    return peak_kilobytes_of(words);
  };
  EXPECT_LT(peak_of(200) - peak_of(100), 39000);
}

}  // namespace
}  // namespace lightproof::test
