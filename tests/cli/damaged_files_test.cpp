// Damaged files by the hundred, as the program meets them: each is read or refused by a message
// with its name; the exit code is 0 or 2; memory and time stay small. LIGHTPROOF_DAMAGES (files of
// each kind) and LIGHTPROOF_DAMAGE_SEED, which ci/damaged sets, make more and others of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/program.h"
#include "tests/image/damaged_files.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;

/// Peak memory of the program and of each decoder; together less than 300 MB.
constexpr long kMostKilobytes = 100'000;

std::uint64_t number_of(const char* variable, std::uint64_t usual) {
  const char* text = std::getenv(variable);
  return text == nullptr ? usual : std::strtoull(text, nullptr, 10);
}

std::uint64_t damages() { return number_of("LIGHTPROOF_DAMAGES", 12); }
std::uint64_t seed() { return number_of("LIGHTPROOF_DAMAGE_SEED", 1); }

/// Writes the files, and returns `lightproof info` with every flag that accepts more.
std::vector<Words> commands_for(const TemporaryFolder& folder,
                                const std::vector<DamagedFile>& files) {
  // The program keeps what it says of each file, so that too many at once would take memory of
  // their own.
  constexpr std::size_t kAtOnce = 300;
  std::vector<Words> commands;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i % kAtOnce == 0) {
      commands.push_back(
          {"info", "--any-aspect", "--repair", "--to-rgb", "--pad", "--crop", "--json"});
    }
    write_bytes(folder / files[i].name, files[i].bytes);
    commands.back().push_back((folder / files[i].name).string());
  }
  return commands;
}

/// The program where fresh memory is filled with a byte.
Finished run_with(const Words& words, const char* fresh_memory) {
  return run({.words = lightproof_command(words).words, .environment = {fresh_memory}});
}

TEST(DamagedFiles, AreReadOrRefusedByName) {
  const TemporaryFolder folder;
  const std::vector<DamagedFile> files = damaged_files(folder / "", damages(), seed());
  ASSERT_GE(files.size(), 200U);
  std::size_t read = 0;
  std::size_t refused = 0;
  long peak = 0;
  for (const Words& words : commands_for(folder, files)) {
    const Finished info = run_with(words, "MALLOC_PERTURB_=0");
    EXPECT_THAT(info.exit_code, AnyOf(0, 2)) << info.err;
    read += json::parse(info.out).size();
    std::istringstream lines(info.err);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_THAT(line, testing::StartsWith("lightproof: " + (folder / "").string()));
      ++refused;
    }
    peak = std::max(peak, peak_kilobytes_of(words));
    EXPECT_EQ(run_with(words, "MALLOC_PERTURB_=90").out, info.out) << "memory that nobody wrote to";
  }
  EXPECT_EQ(read + refused, files.size());
  EXPECT_GT(read, 0U) << "some damages change a pixel";
  EXPECT_GT(refused, files.size() / 4);
  const long most = kHasOwnMemory ? kMostKilobytes : LONG_MAX;
  EXPECT_LT(peak, most);
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("refused", static_cast<int>(refused));
  RecordProperty("peak_kilobytes", static_cast<int>(peak));
}

// Damages that showed memory to which nobody wrote: chunks without bytes, of PIZ and of luminance
// and chroma, and a tile of DWAB.
TEST(DamagedFiles, ShowNothingThatTheyDoNotHold) {
  const TemporaryFolder folder;
  for (const std::uint64_t number : {1010U, 1119U, 1185U, 9085U}) {
    for (const Words& words : commands_for(folder, damaged_files(folder / "", 1, number))) {
      EXPECT_EQ(run_with(words, "MALLOC_PERTURB_=0").out, run_with(words, "MALLOC_PERTURB_=90").out)
          << number;
    }
  }
}

/// The file with the window that its header claims, which is longer than its pixels.
std::string with_claim(std::string exr, int width, int height) {
  for (const char* window : {"dataWindow", "displayWindow"}) {
    // Name, type and length, then the corners: 0, 0 and the last column and row.
    const std::size_t corner = exr.find(window) + std::string(window).size() + 1 + 6 + 4 + 8;
    for (std::size_t i = 0; i < 4; ++i) {
      exr[corner + i] = static_cast<char>((width - 1) >> (8 * i) & 0xff);
      exr[corner + 4 + i] = static_cast<char>((height - 1) >> (8 * i) & 0xff);
    }
  }
  return exr;
}

// The largest picture that is read would take 6.4 GB.
TEST(DamagedFiles, ThatClaimToBeHugeCostLittle) {
  const TemporaryFolder folder;
  // A chunk of PIZ that was made for another size may be one of this size as well.
  const auto expect_small = [&](const std::string& name, const std::string& bytes,
                                std::uintmax_t size, bool may_be_read = false) {
    write_bytes(folder / name, bytes);
    std::filesystem::resize_file(folder / name, size);
    const Words words = {"info", (folder / name).string(), "--any-aspect"};
    const Finished refused = lightproof(words);
    if (!may_be_read || refused.exit_code != 0) {
      EXPECT_EQ(refused.exit_code, 2) << name;
      EXPECT_THAT(refused.err, HasSubstr(name));
    }
    if (!kHasOwnMemory) return;
    EXPECT_LT(peak_kilobytes_of(words), kMostKilobytes) << refused.err;
    EXPECT_LT(refused.seconds, 2.0) << refused.err;
  };
  for (std::size_t i = 0; i < kExrCompressions.size(); ++i) {
    for (const unsigned tile : {0U, 16U}) {
      const auto name = fmt::format("{}-{}.exr", kExrCompressions[i], tile);
      write_compressed_exr(folder / name, numbered_picture({64, 32}), i, false, tile);
      const std::string bytes = bytes_of(folder / name);
      for (const auto& [width, height] : {std::pair{32768, 16384}, {16384, 32768}, {32768, 32}}) {
        const bool may_be_read = kExrCompressions[i] == "piz" && height == 32;
        expect_small(name, with_claim(bytes, width, height), bytes.size(), may_be_read);
        // Long enough that the length says nothing.
        if (i % 4 == 1) {
          expect_small("long-" + name, with_claim(bytes, width, height), 9'000'000);
        }
      }
    }
  }
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 32768\n";
  expect_small("short.hdr", header, 1000);
  expect_small("long.hdr", header, 16'000'000);
}

}  // namespace
}  // namespace lightproof::test
