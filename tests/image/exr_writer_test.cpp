// OpenEXR files of levels, read back by OpenImageIO and by OpenEXR itself.
#include "lightproof/image/exr_writer.h"

#include <ImfHeader.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledInputFile.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/image/reader.h"
#include "lightproof/image/writer.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

MapLevels numbered_pyramid(Extent base, int levels) {
  MapLevels map;
  for (int i = 0; i < levels; ++i) {
    Grid<Rgb> picture = test::numbered_picture(level_extent(base, i));
    for (Rgb& rgb : picture.values()) rgb += Rgb(1000.0F * static_cast<float>(i));
    map.levels.push_back({i / 8.0, {picture}});
  }
  map.attributes = {{"method", "numbers"}, {"source", "sky \xc3\xa4"}};
  return map;
}

class ExrWriter : public testing::Test {
 protected:
  fs::path write(const std::string& bytes) const {
    test::write_bytes(folder_ / "a.exr", bytes);
    return folder_ / "a.exr";
  }

 private:
  test::TemporaryFolder folder_;
};

/// A level as OpenImageIO reads it; empty if there is none.
Grid<Rgb> level_of(OIIO::ImageInput& input, int level) {
  if (!input.seek_subimage(0, level)) return {};
  Grid<Rgb> picture({input.spec().width, input.spec().height});
  EXPECT_TRUE(input.read_image(0, level, 0, 3, OIIO::TypeDesc::FLOAT, picture.values().data()))
      << input.geterror();
  return picture;
}

void expect_equal(const Grid<Rgb>& found, const Grid<Rgb>& expected, int level) {
  ASSERT_EQ(found.extent(), expected.extent()) << "level " << level;
  EXPECT_TRUE(std::ranges::equal(found.values(), expected.values())) << "level " << level;
}

TEST_F(ExrWriter, KeepsEveryLevel) {
  for (const Extent base : {Extent{128, 64}, {100, 50}, {7, 5}, {1, 9}, {1, 1}}) {
    const MapLevels map = numbered_pyramid(base, most_levels(base));
    const auto input = OIIO::ImageInput::open(write(exr_mipmap_bytes(map)).string());
    ASSERT_TRUE(input) << OIIO::geterror();
    for (int i = 0; i < most_levels(base); ++i) {
      expect_equal(level_of(*input, i), map.levels[static_cast<std::size_t>(i)].faces[0], i);
    }
    EXPECT_FALSE(input->seek_subimage(0, most_levels(base))) << "more levels than were written";
  }
}

TEST_F(ExrWriter, FillsTheLevelsThatTheMapDoesNotHave) {
  const MapLevels map = numbered_pyramid({16, 8}, 2);
  const auto input = OIIO::ImageInput::open(write(exr_mipmap_bytes(map)).string());
  ASSERT_TRUE(input) << OIIO::geterror();
  expect_equal(level_of(*input, 1), map.levels[1].faces[0], 1);
  // Level 1 has 8 x 4 texels, numbered from 1001 on: 1001 + x + 8 y. The mean of 2 x 2 is 4.5 above
  // the upper left one.
  const Rgb channels = {0.0F, 0.25F, 0.5F};
  const Grid<Rgb> third = level_of(*input, 2);
  ASSERT_EQ(third.extent(), (Extent{4, 2}));
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const auto first = static_cast<float>(1001 + 2 * x + 16 * y);
      EXPECT_EQ(third(x, y), Rgb(first + 4.5F) + channels);
    }
  }
  EXPECT_EQ(level_of(*input, 4)(0, 0), Rgb(1016.5F) + channels) << "the mean of 1001 to 1032";
  EXPECT_FALSE(input->seek_subimage(0, 5));
  EXPECT_EQ(input->spec(0, 0).get_string_attribute("lightproof.levels"), "2");
}

TEST_F(ExrWriter, MakesCompleteFilesOfTiles) {
  const fs::path file = write(exr_mipmap_bytes(numbered_pyramid({200, 100}, 3)));
  Imf::TiledInputFile input(file.c_str());
  EXPECT_TRUE(input.isComplete());
  EXPECT_EQ(input.levelMode(), Imf::MIPMAP_LEVELS);
  EXPECT_EQ(input.levelRoundingMode(), Imf::ROUND_DOWN);
  EXPECT_EQ(input.tileXSize(), 64U);
  EXPECT_EQ(input.numLevels(), 8);
  EXPECT_FALSE(Imf::hasEnvmap(input.header())) << "it would say that texels are nodes";
}

TEST_F(ExrWriter, SaysHowItWasMade) {
  const auto input =
      OIIO::ImageInput::open(write(exr_mipmap_bytes(numbered_pyramid({8, 4}, 3))).string());
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.get_string_attribute("lightproof.method"), "numbers");
  EXPECT_EQ(spec.get_string_attribute("lightproof.source"), "sky \xc3\xa4");
  EXPECT_EQ(spec.get_string_attribute("lightproof.roughness"), "0, 0.125, 0.25");
  EXPECT_EQ(std::string(spec.get_string_attribute("lightproof.projection")),
            std::string(info(Projection::lat_long).description));
  EXPECT_EQ(spec.get_string_attribute("wrapmodes"), "periodic,clamp");
}

TEST_F(ExrWriter, ShowsLevelZeroToReadersOfPictures) {
  const MapLevels map = numbered_pyramid({16, 8}, 2);
  const EnvironmentMap read = read_environment_map(write(exr_mipmap_bytes(map)));
  expect_equal(flip_rows(read.radiance), map.levels[0].faces[0], 0);
}

TEST_F(ExrWriter, NamesItsPrimaries) {
  const Chromaticities wide = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
  MapLevels map = numbered_pyramid({8, 4}, 2);
  map.chromaticities = wide;
  for (const std::string& bytes :
       {exr_mipmap_bytes(map), exr_bytes(map.levels[0].faces[0], {}, wide)}) {
    const EnvironmentMap read = read_environment_map(write(bytes));
    ASSERT_TRUE(read.origin.picture.chromaticities);
    EXPECT_EQ(name_of(*read.origin.picture.chromaticities), "Rec. 2020");
  }
}

TEST_F(ExrWriter, KeepsBothChannelsOfABrdfMap) {
  BrdfMap map = {.values = Grid<glm::vec2>({5, 3}), .attributes = {{"method", "quadrature"}}};
  float next = 0.1F;
  for (glm::vec2& ab : map.values.values()) {
    next += 0.01F;
    ab = {next, next / 7.0F};
  }
  const auto input = OIIO::ImageInput::open(write(exr_bytes(map)).string());
  ASSERT_TRUE(input) << OIIO::geterror();
  EXPECT_EQ(input->spec().channelnames, (std::vector<std::string>{"R", "G"}));
  EXPECT_EQ(input->spec().get_string_attribute("lightproof.method"), "quadrature");
  Grid<glm::vec2> read({5, 3});
  ASSERT_TRUE(input->read_image(0, 0, 0, 2, OIIO::TypeDesc::FLOAT, read.values().data()));
  EXPECT_TRUE(std::ranges::equal(read.values(), map.values.values()));
}

TEST_F(ExrWriter, GivesTheSameBytesAgain) {
  const MapLevels map = numbered_pyramid({16, 8}, 2);
  EXPECT_EQ(exr_mipmap_bytes(map), exr_mipmap_bytes(map));
}

}  // namespace
}  // namespace lightproof
