// Files that are read: formats, conventions, repair.
#include "lightproof/image/reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lightproof/warp/lat_long.h"
#include "tests/image/picture_files.h"
#include "tests/warp/published_mapping.h"

namespace lightproof {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

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

// A gamma of 1 / 2.2 is what is taken for granted, too.
TEST(Reader, DecodesPngsByTheirOwnGamma) {
  const TemporaryFolder folder;
  for (const double gamma : {1.0, 1.0 / 1.8, 1.0 / 2.2}) {
    test::write_png_with_gamma(folder / "a.png", {2, 1}, {0, 100, 255, 1, 2, 3}, gamma);
    const EnvironmentMap map = read_environment_map(folder / "a.png");
    const auto decoded = [&](unsigned v) {
      return static_cast<float>(std::pow(v / 255.0, 1.0 / gamma));
    };
    EXPECT_FLOAT_EQ(map.radiance(0, 0).g, decoded(100)) << gamma;
    EXPECT_FLOAT_EQ(map.radiance(1, 0).r, decoded(1)) << gamma;
    EXPECT_THAT(map.notes, Contains(HasSubstr(fmt::format("^{}.", std::round(10 / gamma) / 10))));
  }
}

TEST(Reader, DoesNotMultiplyByAlpha) {
  const TemporaryFolder folder;
  test::write_integer_picture(folder / "a.png", {2, 1}, 4, {255, 128, 64, 0, 255, 128, 64, 9}, 8);
  const EnvironmentMap map = read_environment_map(folder / "a.png");
  EXPECT_EQ(map.radiance(0, 0).r, 1.0F);
  EXPECT_EQ(map.radiance(0, 0), map.radiance(1, 0));
}

// Exif's orientations that only flip: 2 mirrors, 3 turns by half a turn, 4 turns upside down.
TEST(Reader, ReadsJpegInItsOrientation) {
  const TemporaryFolder folder;
  std::vector<unsigned> values;  // the upper left quarter bright
  for (unsigned i = 0; i < 32 * 16; ++i) {
    values.insert(values.end(), 3, i % 32 < 16 && i < 32 * 8 ? 200 : 50);
  }
  for (const int orientation : {1, 2, 3, 4}) {
    test::write_integer_picture(folder / "a.jpg", {32, 16}, 3, values, 8, orientation);
    const EnvironmentMap map = read_environment_map(folder / "a.jpg");
    const bool is_left = orientation == 1 || orientation == 4;
    const bool is_upper = orientation <= 2;
    for (const int x : {4, 28}) {
      for (const int y : {4, 12}) {
        const bool is_bright = (x < 16) == is_left && (y >= 8) == is_upper;
        // Quality 100 keeps flat blocks to within 2 of 255: 2.2 * 2 / 200 of the value.
        EXPECT_NEAR(map.radiance(x, y).g, std::pow((is_bright ? 200 : 50) / 255.0, 2.2), 0.02)
            << "orientation " << orientation << " at " << x << ", " << y;
      }
    }
  }
}

class ReaderPreset : public testing::TestWithParam<Preset> {
 protected:
  EnvironmentMap read(const Grid<Rgb>& picture) const {
    const TemporaryFolder folder;
    test::write_exr_file(folder / "a.exr", picture);
    return read_environment_map(folder / "a.exr",
                                {.preset = GetParam(), .any_aspect = true, .resample = true});
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

// Whatever the mapping, the direction of every pixel is that of the preset's formula.
TEST(Reader, KeepsTheTexelsOfTheFile) {
  const TemporaryFolder folder;
  struct Case {
    Preset preset;
    Extent picture;
    Extent texels;
  };
  for (const Case& each : {Case{Preset::pbrt_v4, {6, 6}, {6, 6}},
                           {Preset::cube, {18, 3}, {18, 3}},
                           {Preset::openexr, {9, 5}, {8, 5}},
                           {Preset::pbrt_v3, {7, 3}, {7, 3}},
                           {Preset::z_up_half_turn, {7, 3}, {7, 3}}}) {
    SCOPED_TRACE(info(each.preset).name);
    const Grid<Rgb> picture = test::numbered_picture(each.picture);
    test::write_exr_file(folder / "a.exr", picture);
    const EnvironmentMap map =
        read_environment_map(folder / "a.exr", {.preset = each.preset, .any_aspect = true});
    ASSERT_EQ(map.radiance.extent(), each.texels);
    EXPECT_THAT(map.notes, Contains(HasSubstr("own mapping")));
    const bool has_nodes = info(each.preset).lattice == Lattice::node_centred;
    for (int y = has_nodes ? 1 : 0; y + (has_nodes ? 1 : 0) < each.texels.height; ++y) {
      for (int x = 0; x < each.texels.width; ++x) {
        const Direction d = direction_at(map.mapping, texel_cell(each.texels, x, y).centre());
        const test::PublishedPoint at = test::published_mapping(each.preset, d);
        const auto [width, height] = each.picture;
        const int column = has_nodes
                               ? static_cast<int>(std::lround(at.u * (width - 1))) % (width - 1)
                               : static_cast<int>(at.u * width) % width;
        const int row = has_nodes ? static_cast<int>(std::lround(at.v * (height - 1)))
                                  : static_cast<int>(at.v * height);
        EXPECT_EQ(map.radiance(x, y), picture(column, row)) << x << ' ' << y;
      }
    }
  }
}

TEST(Reader, BringsOctahedralMapsToTwiceTheWidth) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({4, 4}));
  const EnvironmentMap map =
      read_environment_map(folder / "a.exr", {.preset = Preset::pbrt_v4, .resample = true});
  EXPECT_EQ(map.radiance.extent(), (Extent{8, 4}));
  EXPECT_THAT(map.notes, Contains(HasSubstr("octahedral")));
}

TEST(Reader, TellsOfColumnsMovedByHalfATexel) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({7, 3}));
  const ReadOptions options = {.preset = Preset::pbrt_v3, .any_aspect = true, .resample = true};
  EXPECT_THAT(read_environment_map(folder / "a.exr", options).notes, Contains(HasSubstr("odd")));
}

// numbered_picture is linear in column and row, so each texel is the mean of its four nodes; all
// values are multiples of 1/4 below 2^22 and the weights 1/2 up to rounding: exact to 1e-5.
TEST(Reader, InterpolatesNodesOfTheEnvmapAttribute) {
  const TemporaryFolder folder;
  for (const Extent extent : {Extent{8, 4}, {9, 5}}) {
    const Grid<Rgb> picture = test::numbered_picture(extent);
    test::write_exr_file(folder / "a.exr", picture, {.envmap = test::Envmap::lat_long});
    const EnvironmentMap map = read_environment_map(folder / "a.exr", {.resample = true});
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
  const EnvironmentMap map = read_environment_map(folder / "a.exr", {.repair = Repair::zero});
  picture(5, 2).g = picture(6, 3).b = picture(1, 1).r = picture(7, 0).b = picture(2, 2).r = 0.0F;
  EXPECT_TRUE(is_flipped(map, picture));
  EXPECT_THAT(map.notes,
              Contains(HasSubstr("2 texels with negative values (the first at column 5, row 2)")));
  EXPECT_THAT(map.notes, Contains(HasSubstr("1 texel with NaN (at column 1, row 1)")));
  EXPECT_THAT(map.notes, Contains(HasSubstr("2 texels with infinite values (the first at column 7, "
                                            "row 0)")));
}

TEST(Reader, SaysWhatClampingWouldDoWhereInfinityBecomesZero) {
  const TemporaryFolder folder;
  Grid<Rgb> picture = test::numbered_picture({8, 4});
  picture(7, 0).b = kInfinity;
  test::write_exr_file(folder / "a.exr", picture);
  EXPECT_THAT(read_environment_map(folder / "a.exr", {.repair = Repair::zero}).notes,
              Contains(AllOf(HasSubstr("Set to 0"), HasSubstr("--repair=clamp"))));
  picture(7, 0).b = -1.0F;
  test::write_exr_file(folder / "a.exr", picture);
  EXPECT_THAT(read_environment_map(folder / "a.exr", {.repair = Repair::zero}).notes,
              Contains(AllOf(HasSubstr("Set to 0"), Not(HasSubstr("clamp")))));
}

TEST(Reader, ClampsInfinityToTheLargestFiniteValue) {
  const TemporaryFolder folder;
  Grid<Rgb> picture = test::numbered_picture({8, 4});
  picture(2, 1) = Rgb(kInfinity);
  picture(3, 1).g = kInfinity;
  picture(4, 1).b = -kInfinity;
  picture(5, 1).r = std::numeric_limits<float>::quiet_NaN();
  picture(6, 1).r = -2.0F;
  picture(7, 3).r = 1000.0F;
  test::write_exr_file(folder / "a.exr", picture);
  const EnvironmentMap map = read_environment_map(folder / "a.exr", {.repair = Repair::clamp});
  picture(2, 1) = Rgb(1000.0F);
  picture(3, 1).g = 1000.0F;
  picture(4, 1).b = picture(5, 1).r = picture(6, 1).r = 0.0F;
  EXPECT_TRUE(is_flipped(map, picture));
  // The light in what was put in, by solid angle: three channels, and a green one beside them.
  Grid<Rgb> put_in({8, 4});
  put_in(2, 1) = Rgb(1000.0F);
  put_in(3, 1).g = 1000.0F;
  const auto light = [](const Grid<Rgb>& of) {
    double sum = 0.0;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) sum += texel_solid_angle({8, 4}, y) * luminance_of(of(x, y));
    }
    return sum;
  };
  EXPECT_THAT(
      map.notes,
      Contains(AllOf(HasSubstr("+Inf became 1000"),
                     HasSubstr(fmt::format("{:.3g} % of the map's light",
                                           100 * light(put_in) / light(picture))),
                     HasSubstr("3 texels with infinite values"), HasSubstr("1 texel with NaN"))));
}

TEST(Reader, ReadsTheChannelsThatAreNamed) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(
      folder / "a.exr", picture,
      {.channels = {"diffuse.R", "diffuse.G", "diffuse.B", "R", "G", "B", "view.sky.B"}});
  const auto read = [&](const ChannelSelection& selection) {
    return read_environment_map(folder / "a.exr", {.selection = selection});
  };
  EXPECT_TRUE(is_flipped(read({.layer = "diffuse"}), picture));
  EXPECT_TRUE(is_flipped(read({.channels = {"diffuse.R", "diffuse.G", "diffuse.B"}}), picture));
  EXPECT_THAT(read({.layer = "diffuse"}).notes,
              Contains(HasSubstr("Channels left out: R, G, B, view.sky.B")));
  Grid<Rgb> swapped = picture;
  for (Rgb& rgb : swapped.values()) rgb = {rgb.b, rgb.g, rgb.r};
  EXPECT_TRUE(is_flipped(read({.channels = {"B", "G", "R"}, .layer = "diffuse"}), swapped));
  Grid<Rgb> luminance = picture;
  for (Rgb& rgb : luminance.values()) rgb = Rgb(rgb.g);
  const EnvironmentMap single = read({.channels = {"diffuse.G"}});
  EXPECT_TRUE(is_flipped(single, luminance));
  EXPECT_THAT(single.notes, Contains(HasSubstr("diffuse.G was read as grey")));
}

TEST(Reader, ReadsSingleChannelsAsGreyOnRequest) {
  const TemporaryFolder folder;
  const ReadOptions luminance = {.selection = {.channels = {"Y"}}};
  test::write_integer_picture(folder / "a.png", {2, 1}, 1, {0, 255}, 8);
  EXPECT_EQ(read_environment_map(folder / "a.png", luminance).radiance(1, 0), Rgb(1.0F));
  test::write_exr_file(folder / "a.exr", test::numbered_picture({8, 4}), {.channels = {"Y"}});
  EXPECT_EQ(read_environment_map(folder / "a.exr", luminance).radiance(7, 0), Rgb(32.0F));
  test::write_hdr_file(folder / "a.hdr", "-Y 2 +X 4", kRgbe);
  const EnvironmentMap green =
      read_environment_map(folder / "a.hdr", {.selection = {.channels = {"G"}}});
  EXPECT_EQ(green.radiance(0, 1), Rgb(rgbe_picture()(0, 0).g));
}

TEST(Reader, ReadsThePartThatIsAskedFor) {
  const TemporaryFolder folder;
  const Grid<Rgb> second({8, 4}, Rgb(7.0F));
  test::write_two_part_exr(folder / "two.exr", test::numbered_picture({8, 4}), second);
  const EnvironmentMap map = read_environment_map(folder / "two.exr", {.selection = {.part = 1}});
  EXPECT_TRUE(is_flipped(map, second));
  EXPECT_THAT(map.notes, Contains(HasSubstr("Part 1 of 0 to 1 was read (second)")));
  EXPECT_THAT(map.origin.picture.parts, testing::ElementsAre("first", "second"));
}

// Of no size there is no end.
TEST(Reader, TakesNoTilesOfFilesOfLines) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({32, 16});
  test::write_exr_file(folder / "lines.exr", picture);
  const EnvironmentMap lines = read_environment_map(folder / "lines.exr");
  for (const unsigned side : {0U, 4U}) {
    test::write_exr_file(folder / "tiles.exr", picture, {.tiles_of_lines = side});
    const EnvironmentMap map = read_environment_map(folder / "tiles.exr");
    EXPECT_TRUE(std::ranges::equal(map.radiance.values(), lines.radiance.values())) << side;
  }
}

// The display window is the picture; what of it is not stored is black, and what is stored beyond
// it is not seen.
TEST(Reader, BringsPicturesToTheirDisplayWindowOnRequest) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  const auto read = [&](int missing, const Allowances& allow) {
    test::write_exr_file(folder / "a.exr", picture,
                         {.origin_x = -3, .origin_y = 5, .missing_columns = missing});
    return read_environment_map(folder / "a.exr", {.any_aspect = true, .allow = allow});
  };
  const EnvironmentMap padded = read(2, {.pad = true});
  ASSERT_EQ(padded.radiance.extent(), (Extent{10, 4}));
  const EnvironmentMap cropped = read(-2, {.crop = true});
  ASSERT_EQ(cropped.radiance.extent(), (Extent{6, 4}));
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 10; ++x) {
      EXPECT_EQ(padded.radiance(x, 3 - y), x < 8 ? picture(x, y) : Rgb(0.0F)) << x << ' ' << y;
      if (x >= 6) continue;
      EXPECT_EQ(cropped.radiance(x, 3 - y), picture(x, y)) << x << ' ' << y;
    }
  }
  EXPECT_THAT(padded.notes, Contains(HasSubstr("display window (10 x 4)")));
}

// OpenEXR rounds luminance to seven bits and the differences from it to five, half a unit each:
// 2^-8 and 2^-6. R is (RY + 1) Y, B likewise, and G what is left of Y by their weights in it.
TEST(Reader, ConvertsLuminanceAndChromaOnRequest) {
  const TemporaryFolder folder;
  test::write_luminance_chroma_exr(folder / "yc.exr", {32, 16});
  const EnvironmentMap map = read_environment_map(folder / "yc.exr", {.allow = {.to_rgb = true}});
  const double y = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722;
  const auto error_of = [&](double channel) {
    return channel * 0x1p-8 + std::abs(channel - y) * 0x1p-6 + channel * 0x1p-10;
  };
  const double red = error_of(0.5);
  const double blue = error_of(1.0);
  const double green = (y * 0x1p-8 + 0.2126 * red + 0.0722 * blue) / 0.7152;
  for (const Rgb rgb : map.radiance.values()) {
    EXPECT_NEAR(rgb.r, 0.5, red);
    EXPECT_NEAR(rgb.g, 0.25, green);
    EXPECT_NEAR(rgb.b, 1.0, blue);
  }
  EXPECT_THAT(map.notes, Contains(HasSubstr("Luminance and chroma were converted")));
  const EnvironmentMap grey =
      read_environment_map(folder / "yc.exr", {.selection = {.channels = {"Y"}}});
  EXPECT_NEAR(grey.radiance(0, 0).r, y, y * 0x1p-8);
}

// X, Y and Z of the white D65 and of the primaries of Rec. 709 (IEC 61966-2-1, rounded to four
// digits) are white and the primaries again.
TEST(Reader, ConvertsXyzOnRequest) {
  const TemporaryFolder folder;
  Grid<Rgb> picture({2, 2});
  picture(0, 0) = {0.9505F, 1.0F, 1.0891F};
  picture(1, 0) = {0.4124F, 0.2126F, 0.0193F};
  picture(0, 1) = {0.3576F, 0.7152F, 0.1192F};
  picture(1, 1) = {0.1805F, 0.0722F, 0.9505F};
  const std::array<float, 8> xyz = {1, 0, 0, 1, 0, 0, 1.0F / 3, 1.0F / 3};
  test::write_exr_file(folder / "a.exr", picture, {.chromaticities = xyz});
  const EnvironmentMap map = read_environment_map(
      folder / "a.exr", {.repair = Repair::zero, .any_aspect = true, .allow = {.to_rgb = true}});
  const Rgb expected[] = {Rgb(1.0F), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) {
      // Half a unit of the fourth digit, by a matrix whose rows add up to at most 5.4.
      EXPECT_NEAR(map.radiance(i % 2, 1 - i / 2)[c], expected[i][c], 5.4 * 0.5e-4) << i << ' ' << c;
    }
  }
  EXPECT_THAT(map.notes, Contains(HasSubstr("CIE XYZ values were converted")));
}

TEST(Reader, ReadsEveryCompression) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({64, 32});
  for (std::size_t i = 0; i < test::kExrCompressions.size(); ++i) {
    for (const unsigned tile : {0U, 16U}) {
      // Integers and quarters up to 2048.5 with half their bits: 16-bit floats hold 11 of them.
      test::write_compressed_exr(folder / "a.exr", picture, i, false, tile);
      const EnvironmentMap map = read_environment_map(folder / "a.exr");
      const bool has_loss = i >= 5 && i != 6 && i != 7;  // of floats, B44 loses nothing
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
          const float expected = picture(x, 31 - y).g;
          EXPECT_NEAR(map.radiance(x, y).g, expected, has_loss ? 0.05F * expected + 1.0F : 0.0F)
              << test::kExrCompressions[i] << ' ' << tile << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

constexpr std::array<float, 8> kAcesCg = {.713F, .293F, .165F,   .830F,
                                          .128F, .044F, .32168F, .33767F};
constexpr std::array<float, 8> kAp0 = {.7347F, .2653F, 0.0F,    1.0F,
                                       .0001F, -.077F, .32168F, .33767F};

TEST(Reader, NamesPrimariesOtherThanRec709) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  const auto notes = [&](const std::array<float, 8>& chromaticities) {
    test::write_exr_file(folder / "a.exr", picture, {.chromaticities = chromaticities});
    return read_environment_map(folder / "a.exr").notes;
  };
  EXPECT_THAT(notes({.64F, .33F, .3F, .6F, .15F, .06F, .3127F, .329F}), IsEmpty());
  EXPECT_THAT(notes({.6484F, .3309F, .3212F, .5979F, .1559F, .066F, .3457F, .3585F}), IsEmpty());
  EXPECT_THAT(notes(kAcesCg),
              Contains(AllOf(HasSubstr("ACEScg"), HasSubstr("0.2722, 0.6741, 0.0537"),
                             HasSubstr("--luminance file"))));
  EXPECT_THAT(notes(kAp0), Contains(AllOf(HasSubstr("AP0"), HasSubstr("not all positive"))));
}

TEST(Reader, TellsOfPixelsThatAreNotSquare) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.pixel_aspect = 1.5F});
  const EnvironmentMap map = read_environment_map(folder / "a.exr");
  EXPECT_TRUE(is_flipped(map, picture));
  EXPECT_THAT(map.notes, Contains(HasSubstr("pixelAspectRatio=1.5 ")));
}

// A profile of which only the size and the marker are looked at.
TEST(Reader, TellsOfColourProfilesThatMayNotBeSrgb) {
  const TemporaryFolder folder;
  const std::vector<unsigned> values(16 * 8 * 3, 99);
  test::write_integer_picture(folder / "a.jpg", {16, 8}, 3, values, 8);
  EXPECT_THAT(read_environment_map(folder / "a.jpg").notes, Not(Contains(HasSubstr("profile"))));
  std::string bytes = test::bytes_of(folder / "a.jpg");
  const std::string profile(200, 'p');
  std::string marker("\xff\xe2\0\0ICC_PROFILE\0\1\1", 18);
  marker[3] = static_cast<char>(marker.size() - 2 + profile.size());
  bytes.insert(2, marker + profile);
  test::write_bytes(folder / "a.jpg", bytes);
  EXPECT_THAT(read_environment_map(folder / "a.jpg").notes,
              Contains(AllOf(HasSubstr("profile"), HasSubstr("ignored"))));
}

TEST(Reader, WeighsLuminanceAsAskedFor) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.chromaticities = kAcesCg});
  const auto weights = [&](LuminanceChoice choice) {
    return read_environment_map(folder / "a.exr", {.luminance = choice}).weights;
  };
  EXPECT_EQ(weights(LuminanceChoice::rec709), kRec709);
  EXPECT_EQ(weights(LuminanceChoice::published), kPublishedLuminance);
  EXPECT_EQ(weights(LuminanceChoice::average), kAverageLuminance);
  EXPECT_NEAR(weights(LuminanceChoice::file).red, 0.27223, 1e-5);
  test::write_exr_file(folder / "a.exr", picture);
  EXPECT_EQ(weights(LuminanceChoice::file), kRec709);
}

}  // namespace
}  // namespace lightproof
