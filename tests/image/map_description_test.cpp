#include "lightproof/image/map_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/map_identity.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

using nlohmann::json;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Figures, AreNotAddedUpToTheEndOnceTheRunIsInterrupted) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  request_interrupt();
  EXPECT_THROW(figures_of(map), Interrupted);
  EXPECT_THROW(identity_of(map), Interrupted);
  withdraw_interrupt();
}

TEST(Figures, AreThoseOfClosedForms) {
  const MapFigures constant = figures_of(make_synthetic_map("constant", {64, 32}));
  // Sums of 2048 terms, each right to 2^-52.
  EXPECT_NEAR(constant.mean_luminance, 1.0, 1e-12);
  EXPECT_NEAR(constant.effective_fraction, 1.0, 1e-12);
  EnvironmentMap map{.name = "half", .radiance = Grid<Rgb>({64, 32})};
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 32; ++y) map.radiance(x, y) = Rgb(2.0F);
  }
  const MapFigures quarter = figures_of(map);
  EXPECT_NEAR(quarter.mean_luminance, 0.5, 1e-12);
  EXPECT_NEAR(quarter.effective_fraction, 0.25, 1e-12);
  EXPECT_TRUE(
      std::isnan(figures_of({.name = "black", .radiance = Grid<Rgb>({4, 2})}).effective_fraction));
}

// In every convention the peak is named where it lies in the file, and its direction is that of
// the file's pixel.
TEST(Description, NamesThePeakInTheFile) {
  const TemporaryFolder folder;
  for (const PresetInfo& preset : presets()) {
    const Extent extent = preset.aspect == 1.0   ? Extent{16, 16}
                          : preset.aspect == 6.0 ? Extent{48, 8}
                                                 : Extent{16, 8};
    Grid<Rgb> picture(extent, Rgb(1.0F));
    picture(5, 2) = {100.0F, 200.0F, 300.0F};
    test::write_exr_file(folder / "a.exr", picture);
    const MapDescription found =
        describe(read_environment_map(folder / "a.exr", {.preset = preset.preset}));
    const bool nodes = preset.lattice == Lattice::node_centred;
    // Between nodes the peak is spread over the texels around.
    EXPECT_NEAR(found.peak.column, 5, nodes ? 1 : 0) << preset.name;
    EXPECT_NEAR(found.peak.row, 2, nodes ? 1 : 0) << preset.name;
    const SquarePoint at = {5.5 / extent.width, 1.0 - 2.5 / extent.height};
    const double angle = std::acos(
        std::min(1.0, glm::dot(found.peak_direction, direction_from_image(preset.preset, at))));
    // Within one pixel of the 16 around the equator; exact where pixels are texels.
    EXPECT_LE(angle, preset.aspect == 2.0 && !nodes ? 1e-6 : 2.0 * kPi / 16) << preset.name;
  }
}

TEST(Description, ListsFaultsOfFilesThatAreRefused) {
  const TemporaryFolder folder;
  Grid<Rgb> picture({9, 4}, Rgb(1.0F));
  picture(5, 2).g = -1.0F;
  picture(6, 2).g = -1.0F;
  picture(1, 1).b = std::numeric_limits<float>::infinity();
  test::write_exr_file(folder / "a.exr", picture);
  const EnvironmentMap map = inspect_environment_map(folder / "a.exr");
  const json found = json::parse(json_of(describe(map)));
  ASSERT_EQ(found.at("faults").size(), 3U);
  EXPECT_EQ(found["faults"][0]["kind"], "aspect");
  EXPECT_EQ(found["faults"][0]["column"], nullptr);
  EXPECT_EQ(found["faults"][1]["kind"], "infinite values");
  EXPECT_EQ(found["faults"][2]["kind"], "negative values");
  EXPECT_EQ(found["faults"][2]["count"], 2);
  EXPECT_EQ(found["faults"][2]["column"], 5);
  EXPECT_EQ(found["faults"][2]["row"], 2);
  EXPECT_THAT(std::string(found["refused"]), HasSubstr("9 x 4"));
  EXPECT_EQ(found["peak_luminance"], 1.0);
  EXPECT_THAT(map.notes, IsEmpty()) << "nothing was asked to be repaired";
}

TEST(Description, OfABlackFileHasNoFraction) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", Grid<Rgb>({8, 4}));
  const json found = json::parse(json_of(describe(inspect_environment_map(folder / "a.exr"))));
  EXPECT_EQ(found.at("faults")[0]["kind"], "black");
  EXPECT_EQ(found.at("mean_luminance"), 0.0);
  EXPECT_EQ(found.at("effective_fraction"), nullptr);
}

TEST(Description, TellsChannelsLayersAndParts) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture,
                       {.channels = {"R", "G", "B", "Z", "sky.R", "sun.disc.R"}});
  const json found = json::parse(json_of(describe(inspect_environment_map(folder / "a.exr"))));
  EXPECT_THAT(std::vector<std::string>(found.at("layers")), ElementsAre("sky", "sun.disc"));
  EXPECT_THAT(std::vector<std::string>(found.at("left_out")),
              testing::UnorderedElementsAre("Z", "sky.R", "sun.disc.R"));
  EXPECT_EQ(found.at("format"), "OpenEXR");
  EXPECT_EQ(found.at("width"), 8);
  EXPECT_EQ(found.at("height"), 4);
  EXPECT_EQ(found.at("preset"), "z-up");
  test::write_two_part_exr(folder / "two.exr", picture, picture);
  const json two = json::parse(json_of(describe(inspect_environment_map(folder / "two.exr"))));
  EXPECT_THAT(std::vector<std::string>(two.at("parts")), ElementsAre("first", "second"));
  EXPECT_THAT(text_of(describe(inspect_environment_map(folder / "two.exr"))),
              HasSubstr("part 0 of 0 to 1: first, second"));
}

TEST(Description, KeepsToLinesWhateverAFileIsCalled) {
  MapDescription odd = describe(make_synthetic_map("constant", {8, 4}));
  const auto lines = [](const MapDescription& map) {
    const std::string text = text_of(map);
    return std::count(text.begin(), text.end(), '\n');
  };
  const auto usual = lines(odd);
  odd.file = "a\nb\x1b[2J";
  odd.origin.picture.channels.emplace_back("\r\n\x1b[H");
  EXPECT_EQ(lines(odd), usual + 1) << "a line for the channel that is left out";
  EXPECT_THAT(text_of(odd), Not(HasSubstr("\x1b")));
  odd.origin.picture.channels.emplace_back("\xc2\x9b\u202E");
  EXPECT_THAT(text_of(odd), HasSubstr("\\xc2\\x9b\\xe2\\x80\\xae")) << "CSI of C1, right to left";
}

TEST(Description, OfABuiltInMapHasItsSize) {
  const json found = json::parse(json_of(describe(make_synthetic_map("sun-sky", {64, 32}))));
  EXPECT_EQ(found.at("file"), "sun-sky");
  EXPECT_EQ(found.at("format"), "built-in");
  EXPECT_EQ(found.at("width"), 64);
  EXPECT_THAT(found.at("faults"), IsEmpty());
  EXPECT_EQ(found.at("refused"), nullptr);
}

}  // namespace
}  // namespace lightproof
