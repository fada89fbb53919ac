// Files that are read: formats, conventions, repair.
#include "lightproof/image/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "lightproof/warp/lat_long.h"
#include "tests/image/picture_files.h"
#include "tests/warp/published_mapping.h"

namespace lightproof {
namespace {

using test::TemporaryFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

bool is_flipped(const EnvironmentMap& map, const Grid<Rgb>& picture) {
  const Extent extent = picture.extent();
  if (map.radiance.extent() != extent) return false;
  for (int y = 0; y < extent.height; ++y) {
    if (!std::ranges::equal(map.radiance.row(y), picture.row(extent.height - 1 - y))) return false;
  }
  return true;
}

TEST(Reader, ReadsExrWithTheTopRowLast) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "studio.exr", picture);
  const EnvironmentMap map = read_environment_map(folder / "studio.exr");
  EXPECT_TRUE(is_flipped(map, picture));
  EXPECT_EQ(map.name, "studio");
  EXPECT_THAT(map.notes, IsEmpty());
}

TEST(Reader, IgnoresTheOrderOfLines) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({64, 32});
  test::write_exr_file(folder / "a.exr", picture, {.bottom_row_first = true});
  EXPECT_TRUE(is_flipped(read_environment_map(folder / "a.exr"), picture));
}

TEST(Reader, HonoursTheOriginOfTheWindows) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.origin_x = 5, .origin_y = -7});
  EXPECT_TRUE(is_flipped(read_environment_map(folder / "a.exr"), picture));
}

TEST(Reader, LeavesOutFurtherChannelsAndParts) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.channels = {"R", "G", "B", "A", "Z"}});
  const EnvironmentMap map = read_environment_map(folder / "a.exr");
  EXPECT_TRUE(is_flipped(map, picture));
  EXPECT_THAT(map.notes, Contains(HasSubstr("A, Z")));

  test::write_two_part_exr(folder / "two.exr", picture, Grid<Rgb>({8, 4}, Rgb(7.0F)));
  const EnvironmentMap first = read_environment_map(folder / "two.exr");
  EXPECT_TRUE(is_flipped(first, picture));
  EXPECT_THAT(first.notes, Contains(HasSubstr("first of 2 parts")));
}

TEST(Reader, GoesByTheContentNotTheExtension) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.png", picture);
  EXPECT_TRUE(is_flipped(read_environment_map(folder / "a.png"), picture));
}

TEST(Reader, ReadsTheSameTwice) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({64, 32}));
  const EnvironmentMap a = read_environment_map(folder / "a.exr", {.preset = Preset::pbrt_v3});
  const EnvironmentMap b = read_environment_map(folder / "a.exr", {.preset = Preset::pbrt_v3});
  EXPECT_TRUE(std::ranges::equal(a.radiance.values(), b.radiance.values()));
}

// RGBE: mantissa / 256 * 2^(exponent - 128).
const std::vector<test::Rgbe> kRgbe = {{128, 64, 32, 129}, {255, 0, 0, 128},   {0, 255, 0, 128},
                                       {0, 0, 255, 128},   {128, 0, 0, 140},   {64, 64, 64, 128},
                                       {1, 2, 3, 128},     {200, 100, 50, 100}};

Grid<Rgb> rgbe_picture() {
  Grid<Rgb> picture({4, 2});
  for (std::size_t i = 0; i < kRgbe.size(); ++i) {
    const float scale = std::ldexp(1.0F, kRgbe[i].exponent - 136);
    picture.values()[i] = scale * Rgb(kRgbe[i].r, kRgbe[i].g, kRgbe[i].b);
  }
  return picture;
}

TEST(Reader, ReadsRadianceWithoutDecoding) {
  const TemporaryFolder folder;
  test::write_hdr_file(folder / "a.hdr", "-Y 2 +X 4", kRgbe);
  const EnvironmentMap map = read_environment_map(folder / "a.hdr");
  EXPECT_TRUE(is_flipped(map, rgbe_picture()));
  EXPECT_THAT(map.notes, IsEmpty());
}

TEST(Reader, UndoesTheFlipsOfRadianceFiles) {
  const TemporaryFolder folder;
  const Grid<Rgb> stored = rgbe_picture();
  const auto expect_texel = [&](const char* resolution, int column, int row) {
    test::write_hdr_file(folder / "a.hdr", resolution, kRgbe);
    const EnvironmentMap map = read_environment_map(folder / "a.hdr");
    EXPECT_EQ(map.radiance(0, 1), stored(column, row)) << resolution;
    EXPECT_THAT(map.notes, Contains(HasSubstr("orientation")));
  };
  expect_texel("+Y 2 +X 4", 0, 1);
  expect_texel("-Y 2 -X 4", 3, 0);
  expect_texel("+Y 2 -X 4", 3, 1);
}

TEST(Reader, NamesExposureAndGamma) {
  const TemporaryFolder folder;
  test::write_hdr_file(folder / "a.hdr", "-Y 2 +X 4", kRgbe, "EXPOSURE=2\nGAMMA=2.2\n");
  const EnvironmentMap map = read_environment_map(folder / "a.hdr");
  EXPECT_THAT(map.notes, Contains(HasSubstr("EXPOSURE=2")));
  EXPECT_THAT(map.notes, Contains(HasSubstr("gamma")));
  EXPECT_TRUE(is_flipped(map, rgbe_picture()));
}

TEST(Reader, DecodesIntegerPngs) {
  const TemporaryFolder folder;
  for (const int bits : {8, 16}) {
    const unsigned top = bits == 8 ? 255 : 65535;
    test::write_integer_picture(folder / "a.png", {2, 1}, 3, {0, top / 2, top, 1, 2, 3}, bits);
    const EnvironmentMap map = read_environment_map(folder / "a.png");
    const auto decoded = [&](unsigned v) {
      return static_cast<float>(std::pow(v / static_cast<double>(top), 2.2));
    };
    EXPECT_EQ(map.radiance(0, 0), Rgb(0.0F, decoded(top / 2), 1.0F));
    EXPECT_EQ(map.radiance(1, 0), Rgb(decoded(1), decoded(2), decoded(3)));
    EXPECT_THAT(map.notes, Contains(HasSubstr(std::to_string(bits) + "-bit")));
  }
}

TEST(Reader, DoesNotMultiplyByAlpha) {
  const TemporaryFolder folder;
  test::write_integer_picture(folder / "a.png", {2, 1}, 4, {255, 128, 64, 0, 255, 128, 64, 9}, 8);
  const EnvironmentMap map = read_environment_map(folder / "a.png");
  EXPECT_EQ(map.radiance(0, 0).r, 1.0F);
  EXPECT_EQ(map.radiance(0, 0), map.radiance(1, 0));
}

TEST(Reader, ReadsJpegInItsOrientation) {
  const TemporaryFolder folder;
  std::vector<unsigned> values;  // the upper half bright
  for (unsigned i = 0; i < 32 * 16 * 3; ++i) values.push_back(i < 32 * 8 * 3 ? 200 : 50);
  for (const int orientation : {1, 4}) {
    test::write_integer_picture(folder / "a.jpg", {32, 16}, 3, values, 8, orientation);
    const EnvironmentMap map = read_environment_map(folder / "a.jpg");
    const int bright_row = orientation == 1 ? 15 : 0;
    // Quality 100 keeps flat blocks to within 2 of 255: 2.2 * 2 / 200 of the value.
    EXPECT_NEAR(map.radiance(16, bright_row).g, std::pow(200 / 255.0, 2.2), 0.02);
    EXPECT_NEAR(map.radiance(16, 15 - bright_row).g, std::pow(50 / 255.0, 2.2), 0.02);
  }
}

class ReaderPreset : public testing::TestWithParam<Preset> {
 protected:
  EnvironmentMap read(const Grid<Rgb>& picture) const {
    const TemporaryFolder folder;
    test::write_exr_file(folder / "a.exr", picture);
    return read_environment_map(folder / "a.exr", {.preset = GetParam(), .any_aspect = true});
  }
};

TEST_P(ReaderPreset, PutsEveryPixelWhereItsFormulaSays) {
  const Extent extent = info(GetParam()).aspect == 1.0 ? Extent{16, 16} : Extent{16, 8};
  const Grid<Rgb> picture = test::numbered_picture(extent);
  const EnvironmentMap map = read(picture);
  const auto [width, height] = map.radiance.extent();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Direction d = direction_from_square({(x + 0.5) / width, (y + 0.5) / height});
      const test::PublishedPoint at = test::published_mapping(GetParam(), d);
      const int column = static_cast<int>(at.u * extent.width) % extent.width;
      const int row = static_cast<int>(at.v * extent.height);
      EXPECT_EQ(map.radiance(x, y), picture(column, row)) << x << ' ' << y;
    }
  }
}

TEST_P(ReaderPreset, UsesEveryPixelOnce) {
  if (info(GetParam()).aspect == 1.0) GTEST_SKIP() << "octahedral maps are resampled";
  for (const Extent extent : {Extent{8, 4}, {64, 32}, {7, 3}, {33, 16}, {1, 1}, {1, 5}, {5, 1}}) {
    const Grid<Rgb> picture = test::numbered_picture(extent);
    const EnvironmentMap map = read(picture);
    std::set<float> values;
    for (const Rgb rgb : map.radiance.values()) values.insert(rgb.r);
    EXPECT_EQ(map.radiance.extent(), extent);
    EXPECT_EQ(values.size(), extent.count()) << extent.width << ' ' << extent.height;
  }
}

std::string test_name(const testing::TestParamInfo<Preset>& parameter) {
  std::string name(info(parameter.param).name);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

// By its formula a convention moves an odd number of columns by half a texel if the centre of one
// falls on an edge between two pixels.
TEST_P(ReaderPreset, TellsOfColumnsMovedByHalfATexelWhereItsFormulaMovesThem) {
  if (info(GetParam()).aspect == 1.0) GTEST_SKIP() << "octahedral maps are resampled";
  for (const Extent extent : {Extent{7, 3}, Extent{8, 4}, Extent{1, 1}, Extent{9, 4}}) {
    const Direction first = direction_from_square({0.5 / extent.width, 0.5});
    const double column = test::published_mapping(GetParam(), first).u * extent.width;
    const bool moved = std::abs(test::fraction(column) - 0.5) > 0.25;
    const auto notes = read(test::numbered_picture(extent)).notes;
    EXPECT_EQ(testing::Value(notes, Contains(HasSubstr("half a texel"))), moved) << extent.width;
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, ReaderPreset,
                         testing::Values(Preset::z_up, Preset::z_up_half_turn, Preset::exr_area,
                                         Preset::pbrt_v3, Preset::pbrt_v4, Preset::mitsuba),
                         test_name);

TEST(Reader, BringsOctahedralMapsToTwiceTheWidth) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({4, 4}));
  const EnvironmentMap map = read_environment_map(folder / "a.exr", {.preset = Preset::pbrt_v4});
  EXPECT_EQ(map.radiance.extent(), (Extent{8, 4}));
  EXPECT_THAT(map.notes, Contains(HasSubstr("octahedral")));
}

TEST(Reader, TellsOfColumnsMovedByHalfATexel) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({7, 3}));
  const ReadOptions options = {.preset = Preset::pbrt_v3, .any_aspect = true};
  EXPECT_THAT(read_environment_map(folder / "a.exr", options).notes, Contains(HasSubstr("odd")));
}

// numbered_picture is linear in column and row, so each texel is the mean of its four nodes; all
// values are multiples of 1/4 below 2^22 and the weights 1/2 up to rounding: exact to 1e-5.
TEST(Reader, InterpolatesNodesOfTheEnvmapAttribute) {
  const TemporaryFolder folder;
  for (const Extent extent : {Extent{8, 4}, {9, 5}}) {
    const Grid<Rgb> picture = test::numbered_picture(extent);
    test::write_exr_file(folder / "a.exr", picture, {.envmap = test::Envmap::lat_long});
    const EnvironmentMap map = read_environment_map(folder / "a.exr");
    ASSERT_EQ(map.radiance.extent(), (Extent{extent.width - 1, extent.height - 1}));
    EXPECT_THAT(map.notes, Contains(HasSubstr("preset openexr")));
    EXPECT_THAT(map.notes, Contains(HasSubstr("bilinearly")));
    for (int r = 0; r + 1 < extent.height; ++r) {
      for (int x = 0; x + 1 < extent.width; ++x) {
        const float mean = (picture(x, r).g + picture(x + 1, r + 1).g) / 2;
        EXPECT_NEAR(map.radiance(x, extent.height - 2 - r).g, mean, 1e-5);
      }
    }
  }
}

TEST(Reader, PrefersTheNamedPresetToTheAttribute) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.envmap = test::Envmap::lat_long});
  const EnvironmentMap map = read_environment_map(folder / "a.exr", {.preset = Preset::z_up});
  EXPECT_TRUE(is_flipped(map, picture));
}

TEST(Reader, RepairsOnRequestAndSaysSo) {
  const TemporaryFolder folder;
  Grid<Rgb> picture = test::numbered_picture({8, 4});
  picture(5, 2).g = -3.0F;
  picture(6, 3).b = -1.0F;
  picture(1, 1).r = std::numeric_limits<float>::quiet_NaN();
  picture(7, 0).b = std::numeric_limits<float>::infinity();
  picture(2, 2).r = -std::numeric_limits<float>::infinity();
  test::write_exr_file(folder / "a.exr", picture);
  const EnvironmentMap map = read_environment_map(folder / "a.exr", {.repair = true});
  picture(5, 2).g = picture(6, 3).b = picture(1, 1).r = picture(7, 0).b = picture(2, 2).r = 0.0F;
  EXPECT_TRUE(is_flipped(map, picture));
  EXPECT_THAT(map.notes,
              Contains(HasSubstr("2 texels with negative values (the first at column 5, row 2)")));
  EXPECT_THAT(map.notes, Contains(HasSubstr("1 texel with NaN (at column 1, row 1)")));
  EXPECT_THAT(map.notes, Contains(HasSubstr("2 texels with infinite values (the first at column 7, "
                                            "row 0)")));
}

}  // namespace
}  // namespace lightproof
