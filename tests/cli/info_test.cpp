// lightproof info: what it prints of good files, of bad ones, and of both together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::string text_in(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Info : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static Finished info(Words words) {
    words.insert(words.begin(), "info");
    return lightproof(words);
  }
  static json info_json(Words words) {
    words.emplace_back("--json");
    return json::parse(info(words).out);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Info, GivesTheKeysThatOtherProgramsReadAndTheFiguresOfTheMap) {
  write_map(path("a.exr"), {8, 4},
            [](Grid<Rgb>& picture) { std::ranges::fill(picture.values(), Rgb(2.0F)); });
  const json found = info_json({path("a.exr")});
  for (const char* key :
       {"file", "format", "width", "height", "preset", "channels", "layers", "mean_luminance",
        "peak_luminance", "peak_direction", "effective_fraction", "faults", "notes"}) {
    EXPECT_TRUE(found.contains(key)) << key;
  }
  EXPECT_EQ(found.at("file"), path("a.exr"));
  EXPECT_NEAR(found.at("mean_luminance").get<double>(), 2.0, 1e-6);  // Rec. 709 sums to 1
  EXPECT_NEAR(found.at("effective_fraction").get<double>(), 1.0, 1e-12);
  EXPECT_EQ(found.at("peak_direction").size(), 3U);
}

TEST_F(Info, GivesAnArrayForSeveralFiles) {
  write_map(path("a.exr"));
  const json found = info_json({path("a.exr"), "sun-sky"});
  ASSERT_TRUE(found.is_array());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].at("file"), "sun-sky");
}

TEST_F(Info, DescribesWhatTheGateRefuses) {
  write_map(path("bad.exr"), {9, 4},
            [](Grid<Rgb>& picture) { picture(5, 2).g = std::numeric_limits<float>::quiet_NaN(); });
  EXPECT_EQ(quick_gate({path("bad.exr")}).exit_code, 2);
  const Finished text = info({path("bad.exr")});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(StartsWith(path("bad.exr") + "\n"), HasSubstr("column 5, row 2"),
                              HasSubstr("9 x 4")));
  EXPECT_EQ(info_json({path("bad.exr")}).at("faults").size(), 2U);
}

TEST_F(Info, GoesOnAfterAFileThatCannotBeRead) {
  write_map(path("good.exr"));
  const Words files = {path("none.exr"), path("good.exr")};
  for (const Words& words : {files, Words{files[0], files[1], "--json"}}) {
    const Finished both = info(words);
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_THAT(both.err, AllOf(HasSubstr("none.exr"), HasSubstr("no such file")));
  }
  EXPECT_THAT(info(files).out, AllOf(HasSubstr("good.exr"), Not(HasSubstr("none.exr"))));
  const json found = info_json(files);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].at("file"), path("good.exr"));
  EXPECT_THAT(info({path("none.exr"), "--json"}).out, IsEmpty());
}

TEST_F(Info, LetsNoNameControlTheTerminal) {
  EXPECT_THAT(info({path("a\x1b[2J.exr")}).err,
              AllOf(HasSubstr("a\\x1b[2J.exr"), Not(HasSubstr("\x1b"))));
}

TEST_F(Info, NeedsAFile) { EXPECT_EQ(info({}).exit_code, 2); }

TEST_F(Info, ReadsWhatTheOptionsChoose) {
  write_exr_file(path("a.exr"), numbered_picture({8, 4}),
                 {.channels = {"sky.R", "sky.G", "sky.B"}});
  EXPECT_EQ(info({path("a.exr")}).exit_code, 2);
  EXPECT_EQ(info({path("a.exr"), "--part", "1"}).exit_code, 2);
  EXPECT_THAT(Words(info_json({path("a.exr"), "--layer", "sky"}).at("read")),
              ElementsAre("sky.R", "sky.G", "sky.B"));
  const json luminance = info_json({path("a.exr"), "--channels", "sky.G", "--part", "0"});
  EXPECT_THAT(Words(luminance.at("read")), ElementsAre("sky.G"));
  EXPECT_NEAR(luminance.at("peak_luminance").get<double>(), 32.25, 1e-12);
}

// The least that a process of this program takes, with all its libraries, and no more than a
// hundred megabytes beside: the picture that the header claims would take 1.6 GB.
TEST_F(Info, TakesNoMemoryForWhatAHeaderOnlyClaims) {
  const long usual = info({"constant", "--size", "8x4"}).peak_kilobytes;
  const auto expect_small = [&](const std::string& name, const std::string& bytes) {
    write_bytes(path(name), bytes);
    const Finished refused = info({path(name)});
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_THAT(refused.err, HasSubstr(name));
    if (!kHasOwnMemory) return;
    EXPECT_LT(refused.peak_kilobytes, usual + 100'000) << name << "\n" << refused.err;
  };
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n";
  expect_small("short.hdr", header + std::string(1000, '\x80'));
  expect_small("longer.hdr", header + std::string(200'000, '\x80'));

  write_map(path("small.exr"), {64, 32});
  std::string exr = bytes_of(path("small.exr"));
  for (const char* window : {"dataWindow", "displayWindow"}) {
    // Name, type and length, then the corners: 0, 0 and the last column and row.
    const std::size_t corner = exr.find(window) + std::string(window).size() + 1 + 6 + 4 + 8;
    exr.replace(corner, 8, std::string("\xff\x3f\0\0\xff\x1f\0\0", 8));
  }
  expect_small("claim.exr", exr);
}

TEST_F(Info, DrawsAMapInTheConventionOfItsFileOrOfTheOption) {
  write_map(path("a.exr"));
  const Finished of_file = info({path("a.exr"), "--preset", "mitsuba", "--drawing", path("a.svg")});
  EXPECT_EQ(of_file.exit_code, 0) << of_file.err;
  EXPECT_THAT(of_file.out, HasSubstr("a.exr"));
  EXPECT_THAT(text_in(path("a.svg")),
              AllOf(StartsWith("<svg"), HasSubstr("a in `mitsuba`"), HasSubstr("+z = +Y")));
  const Finished built_in = info({"sun-sky", "--preset", "pbrt-v4", "--drawing", "-"});
  EXPECT_EQ(built_in.exit_code, 0) << built_in.err;
  EXPECT_THAT(built_in.out, AllOf(StartsWith("<svg"), HasSubstr("sun-sky in `pbrt-v4`")));
}

TEST_F(Info, RefusesADrawingOfSeveralMapsOrBesideOtherText) {
  const Finished several = info({"constant", "sun-sky", "--drawing", path("a.svg")});
  EXPECT_EQ(several.exit_code, 2);
  EXPECT_THAT(several.err, HasSubstr("--drawing is of one map, and 2 are given"));
  const Finished twice = info({"constant", "--json", "--drawing", "-"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("only one output can be the standard output"));
  EXPECT_EQ(info({"constant", "--drawing", path("no/such/folder.svg")}).exit_code, 2);
}

}  // namespace
}  // namespace lightproof::test
