// lightproof precompute: what it writes, what it refuses, and what is left after an interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

/// Whether a file whose name begins so is in the folder within a minute.
bool wait_for(const std::filesystem::path& folder, const std::string& beginning) {
  const auto is_there = [&] {
    if (!std::filesystem::exists(folder)) return false;
    return std::ranges::any_of(names_in(folder), [&](const std::string& name) {
      return name.starts_with(beginning) && name.ends_with(".bin");
    });
  };
  for (int i = 0; i < 6000 && !is_there(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return is_there();
}

class PrecomputeCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Of a small built-in map, into the folder "made".
  Words words(Words more) const {
    Words all = {"precompute", "sun-sky", "--map-size", "32x16", "-o", path("made")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Finished precompute(Words more) const { return lightproof(words(std::move(more))); }
  Words made() const { return names_in(path("made")); }
  json results() const { return json_of(path("made/precompute.json")); }

 private:
  TemporaryFolder folder_;
};

TEST_F(PrecomputeCommand, MakesEveryMapWithAPageAndFiguresThatFollowTheSchema) {
  const Finished finished = precompute({"--size", "16x8", "--check", "--check-texels", "4"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(made(), testing::ElementsAre("brdf-map.exr", "irradiance.exr", "manifest.json",
                                           "precompute.json", "preview.html", "reflectivity.exr",
                                           "specular.exr"));
  expect_valid("precompute.schema.json", path("made/precompute.json"));
  for (const json& map : results().at("precomputed")) {
    for (const json& level : map.at("levels")) {
      EXPECT_LT(level.at("error").at("value").get<double>(), 1e-3) << map.at("name");
    }
  }
  EXPECT_THAT(finished.out, AllOf(HasSubstr("specular"), HasSubstr("roughness")));
}

TEST_F(PrecomputeCommand, WritesOneKtx2FileWithAllFacesAndLevels) {
  const Finished finished =
      lightproof({"precompute", "gradient", "-o", path("made"), "--specular", "--projection",
                  "cube", "--format", "ktx2", "--size", "8x8", "--levels", "3"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(made(), Contains("specular.ktx2"));
  EXPECT_EQ(results().at("precomputed").at(0).at("levels").size(), 3U);
}

TEST_F(PrecomputeCommand, KeepsSnapshotsOfTheAccumulation) {
  ASSERT_EQ(precompute({"--reflectivity", "--size", "8x4", "--levels", "2", "--samples", "64",
                        "--snapshots"})
                .exit_code,
            0);
  EXPECT_THAT(made(), IsSupersetOf({"reflectivity-frame-1.exr", "reflectivity-frame-2.exr",
                                    "reflectivity-frame-4.exr"}));
}

TEST_F(PrecomputeCommand, EndsWithOneAboveTheLargestError) {
  const Words noisy = {"--specular",  "--size", "16x8",     "--levels",    "3",         "--check",
                       "--max-error", "1e-4",   "--method", "half-vector", "--samples", "16"};
  EXPECT_EQ(precompute(noisy).exit_code, 1);
  EXPECT_THAT(made(), Contains("specular.exr")) << "made all the same, and measured";
}

TEST_F(PrecomputeCommand, ChoosesTheSmallestSizeThatReachesAnError) {
  const Finished finished = lightproof({"precompute", "gradient", "--map-size", "64x32", "-o",
                                        path("made"), "--irradiance", "--max-error", "0.02"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json size = results().at("precomputed").at(0).at("levels").at(0).at("size");
  EXPECT_LT(size.at(0).get<int>(), 64);
  EXPECT_THAT(finished.err, HasSubstr("irradiance: "));
}

TEST_F(PrecomputeCommand, RefusesWhatMakesNoSenseAndLeavesNothing) {
  const std::pair<Words, const char*> cases[] = {
      {{"--size", "0x8"}, "0x8"},
      {{"--specular", "--size", "8x4", "--levels", "9"}, "9"},
      {{"--specular", "--projection", "cube", "--size", "8x4"}, "8"},
      {{"--method", "magic"}, "magic"},
      {{"--format", "tga"}, "tga"},
      {{"--masking", "smith"}, "smith"},
      {{"--max-error", "-1"}, "-1"},
  };
  for (const auto& [options, named] : cases) {
    const Finished finished = precompute(options);
    EXPECT_EQ(finished.exit_code, 2) << named;
    EXPECT_THAT(finished.err, HasSubstr(named));
    EXPECT_FALSE(std::filesystem::exists(path("made/manifest.json"))) << named;
  }
}

TEST_F(PrecomputeCommand, RefusesValuesThatTheFormatCannotHold) {
  const std::string map = path("bright.exr");
  write_map(map, {8, 4}, [](Grid<Rgb>& picture) { picture(3, 1) = Rgb(1e6F); });
  const Words command = {"precompute", map,        "-o", path("made"), "--specular", "--size",
                         "8x4",        "--levels", "2",  "--format",   "ktx2"};
  const Finished refused = lightproof(command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("65504"), HasSubstr("--clamp --resume")));
  Words clamped = command;
  clamped.insert(clamped.end(), {"--clamp", "--resume"});
  const Finished finished = lightproof(clamped);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err, HasSubstr("65504"));
}

TEST_F(PrecomputeCommand, GoesOnAfterAnInterruption) {
  // Levels one by one, each of which takes a while; the last ones are quick.
  Words slow = words({"--specular", "--method", "half-vector", "--samples", "4096", "--size",
                      "128x64", "--levels", "8"});
  Process process(lightproof_command(slow));
  ASSERT_TRUE(wait_for(path("made/unfinished"), "specular-1-"));
  process.send(SIGINT);
  const Finished interrupted = process.wait(std::chrono::seconds(60));
  EXPECT_EQ(interrupted.exit_code, 130);
  EXPECT_FALSE(std::filesystem::exists(path("made/specular.exr")));
  const Finished refused = lightproof(slow);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--resume"));
  // Neither the format nor what is clamped changes a level.
  slow.insert(slow.end(), {"--resume", "--format", "ktx2", "--clamp"});
  const Finished resumed = lightproof(slow);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(made(), AllOf(Contains("specular.ktx2"), Not(Contains("unfinished"))));
}

}  // namespace
}  // namespace lightproof::test
