// Options that say how files are read, on the gate: what they do, and that a replay has them too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class InputOptions : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(InputOptions, RepairTakesNoFileForItsValue) {
  write_map(path("a.exr"), {8, 4}, [](Grid<Rgb>& picture) { picture(5, 2).g = kInfinity; });
  const Finished before = quick_gate({"--repair", path("a.exr"), "--sampler", "alias"});
  EXPECT_EQ(before.exit_code, 0) << before.err;
  EXPECT_THAT(before.err, AllOf(HasSubstr("Set to 0"), HasSubstr("--repair=clamp")));
  const Finished clamped = quick_gate({path("a.exr"), "--repair=clamp", "--sampler", "alias"});
  EXPECT_EQ(clamped.exit_code, 0) << clamped.err;
  EXPECT_THAT(clamped.err, AllOf(HasSubstr("+Inf became 32.5"), HasSubstr("% of the map's light")));
  const Finished unknown = quick_gate({path("a.exr"), "--repair=mend"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--repair"));
}

TEST_F(InputOptions, APresetSaysHowAFileIsReadAndIsRefusedWithoutOne) {
  const Finished refused = quick_gate({"constant", "--preset", "cube"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--preset: it says how the pixels of a file map"));
  write_map(path("a.exr"));
  EXPECT_EQ(quick_gate({"constant", path("a.exr"), "--preset", "exr-area", "--sampler", "alias"})
                .exit_code,
            0);
}

TEST_F(InputOptions, ChannelsAreOneOrThree) {
  write_map(path("a.exr"));
  for (const char* names : {"R,G", "R,G,B,A", "R,,B", ","}) {
    const Finished refused = quick_gate({path("a.exr"), "--channels", names});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--channels"), HasSubstr(names)));
  }
}

TEST_F(InputOptions, StandInTheCommandThatDrawsTheSameSamplesAgain) {
  write_exr_file(path("a.exr"), numbered_picture({64, 32}),
                 {.channels = {"my sky.R", "my sky.G", "my sky.B"}});
  const auto gate = gate_results({path("a.exr"), "-n", "65536", "--sampler", "no-sine", "--layer",
                                  "my sky", "--part", "0", "--repair=clamp", "--luminance",
                                  "average", "--channels", "B,G,R", "--pad", "--crop", "--to-rgb"});
  ASSERT_FALSE(gate.at("rejections").empty());
  const std::string replay = gate.at("rejections")[0].at("replay");
  EXPECT_THAT(replay, AllOf(HasSubstr("--layer 'my sky'"), HasSubstr("--part 0"),
                            HasSubstr("--repair=clamp"), HasSubstr("--luminance average"),
                            HasSubstr("--channels B,G,R"), HasSubstr("--pad --crop --to-rgb")));
}

// Under the lecture's weights the published sampler and all others declare one density; what is
// drawn must follow, and the gate must see it.
TEST_F(InputOptions, LuminanceIsWhatSamplersDrawBy) {
  write_map(path("a.exr"), {64, 32}, [](Grid<Rgb>& picture) {
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) picture(x, y) = x < 32 ? Rgb(8, 1, 1) : Rgb(1, 1, 8);
    }
  });
  for (const char* luminance : {"rec709", "published", "average", "file"}) {
    const Finished gate = lightproof(
        {"gate", path("a.exr"), "-n", "65536", "--sound-only", "--luminance", luminance});
    EXPECT_EQ(gate.exit_code, 0) << luminance << gate.out << gate.err;
  }
}

}  // namespace
}  // namespace lightproof::test
