#include "lightproof/image/map_files.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lightproof/core/error.h"
#include "lightproof/image/exr_writer.h"
#include "lightproof/image/ktx2_writer.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/writer.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Values that every format keeps: multiples of 1/128 up to 1, grey.
MapLevels grey_map(Projection projection, int levels) {
  const Extent base = is_cube(projection) ? Extent{8, 8} : Extent{16, 8};
  MapLevels map = {.projection = projection, .levels = {}, .attributes = {{"method", "numbers"}}};
  int next = 0;
  for (int i = 0; i < levels; ++i) {
    MapLevel level = {.roughness = i / 4.0, .faces = {}};
    for (int face = 0; face < info(projection).faces; ++face) {
      level.faces.emplace_back(level_extent(base, i));
      for (Rgb& rgb : level.faces.back().values()) {
        rgb = Rgb(static_cast<float>(64 + next++ % 64) / 128.0F);
      }
    }
    map.levels.push_back(level);
  }
  return map;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

template <class Write>
std::string refusal(const Write& write) {
  try {
    write();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string text_attribute(const fs::path& file, const std::string& name) {
  const auto input = OIIO::ImageInput::open(file.string());
  return input ? std::string(input->spec().get_string_attribute(name)) : OIIO::geterror();
}

TEST(MapFiles, HaveTheNamesThatAreForetold) {
  for (const ProjectionInfo& projection : projections()) {
    for (const MapFormatInfo& format : map_formats()) {
      for (const int levels : {1, 3}) {
        const test::TemporaryFolder folder;
        write_map(folder / "", "specular", grey_map(projection.projection, levels), format.format);
        const std::vector<std::string> names =
            map_file_names("specular", projection.projection, levels, format.format);
        EXPECT_EQ(files_in(folder / ""), std::set<std::string>(names.begin(), names.end()));
      }
    }
  }
}

TEST(MapFiles, AreNamedByLevelAndFace) {
  EXPECT_THAT(map_file_names("a", Projection::lat_long, 2, MapFormat::exr), ElementsAre("a.exr"));
  EXPECT_THAT(map_file_names("a", Projection::cube, 9, MapFormat::ktx2), ElementsAre("a.ktx2"));
  EXPECT_THAT(map_file_names("a", Projection::lat_long, 2, MapFormat::hdr),
              ElementsAre("a_m0.hdr", "a_m1.hdr"));
  EXPECT_THAT(map_file_names("a", Projection::lat_long, 1, MapFormat::png), ElementsAre("a.png"));
  EXPECT_THAT(map_file_names("a", Projection::cube, 1, MapFormat::exr),
              ElementsAre("a_px.exr", "a_nx.exr", "a_py.exr", "a_ny.exr", "a_pz.exr", "a_nz.exr"));
  EXPECT_EQ(map_file_names("a", Projection::cube, 2, MapFormat::exr)[7], "a_m1_nx.exr");
}

TEST(MapFiles, HoldEachFaceAndLevelUnderItsName) {
  const MapLevels map = grey_map(Projection::cube, 2);
  for (const MapFormat format : {MapFormat::exr, MapFormat::hdr}) {
    const test::TemporaryFolder folder;
    write_map(folder / "", "a", map, format);
    const std::vector<std::string> names = map_file_names("a", Projection::cube, 2, format);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const EnvironmentMap read = read_environment_map(folder / names[i], {.any_aspect = true});
      EXPECT_TRUE(std::ranges::equal(flip_rows(read.radiance).values(),
                                     map.levels[i / 6].faces[i % 6].values()))
          << names[i];
    }
  }
}

TEST(MapFiles, AreThoseOfTheWriters) {
  const test::TemporaryFolder folder;
  const MapLevels cube = grey_map(Projection::cube, 2);
  write_map(folder / "", "a", cube, MapFormat::ktx2);
  EXPECT_EQ(test::bytes_of(folder / "a.ktx2"), ktx2_bytes(cube));
  const MapLevels map = grey_map(Projection::lat_long, 2);
  write_map(folder / "", "a", map, MapFormat::exr);
  EXPECT_EQ(test::bytes_of(folder / "a.exr"), exr_mipmap_bytes(map));
}

TEST(MapFiles, SayHowTheyWereMade) {
  const test::TemporaryFolder folder;
  MapLevels map = grey_map(Projection::cube, 2);
  map.attributes.push_back({"source", "Z\xc3\xbcrich"});
  write_map(folder / "", "a", map, MapFormat::exr);
  write_map(folder / "", "a", map, MapFormat::png);
  for (const char* name : {"a_m1_ny.exr", "a_m1_ny.png"}) {
    EXPECT_EQ(text_attribute(folder / name, "lightproof.method"), "numbers") << name;
    EXPECT_EQ(text_attribute(folder / name, "lightproof.source"), "Z\xc3\xbcrich") << name;
    EXPECT_EQ(text_attribute(folder / name, "lightproof.face"), "-Y") << name;
    EXPECT_EQ(text_attribute(folder / name, "lightproof.level"), "1 of 0 to 1") << name;
    EXPECT_EQ(text_attribute(folder / name, "lightproof.roughness"), "0.25") << name;
  }
  EXPECT_THAT(text_attribute(folder / "a_m1_ny.png", "lightproof.transfer"),
              AllOf(HasSubstr("c / (1 + c)"), HasSubstr("sRGB")));
  write_map(folder / "", "a", map, MapFormat::hdr);
  EXPECT_THAT(test::bytes_of(folder / "a_m1_ny.hdr"),
              AllOf(HasSubstr("# lightproof.method=numbers\n"), HasSubstr("# lightproof.face=-Y\n"),
                    HasSubstr("# lightproof.source=Z\xc3\xbcrich\n")));
}

TEST(MapFiles, ShowAMapByReinhardsCurve) {
  const test::TemporaryFolder folder;
  Grid<Rgb> picture({2, 1}, Rgb(1.0F));
  picture(1, 0) = Rgb(0.0F, 3.0F, 1e30F);
  write_map(folder / "", "a", {.levels = {{std::nullopt, {picture}}}}, MapFormat::png);
  const auto input = OIIO::ImageInput::open((folder / "a.png").string());
  std::vector<unsigned char> values(6);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data()));
  // 1/2, 0, 3/4 and 1 as codes of sRGB: see ToneMappedByte.
  EXPECT_THAT(values, ElementsAre(188, 188, 188, 0, 225, 255));
  EXPECT_EQ(input->spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
}

TEST(MapFiles, AreNotWrittenIfAValueDoesNotFit) {
  const test::TemporaryFolder folder;
  MapLevels map = grey_map(Projection::cube, 2);
  map.levels[1].faces[3](1, 1).g = 1e5F;
  EXPECT_THAT(refusal([&] { write_map(folder / "", "sky", map, MapFormat::ktx2); }),
              AllOf(HasSubstr((folder / "sky.ktx2").string()), HasSubstr("up to 100000"),
                    HasSubstr("level 1, face -Y, column 1, row 1")));
  map.levels[1].faces[3](1, 1).g = -1.0F;
  EXPECT_THAT(refusal([&] { write_map(folder / "", "sky", map, MapFormat::hdr); }),
              HasSubstr("sky_m0_px.hdr: not written"));
  EXPECT_TRUE(fs::is_empty(folder / ""));
  write_map(folder / "", "sky", map, MapFormat::hdr, OutOfRange::clamped);
  EXPECT_EQ(files_in(folder / "").size(), 12U);
}

TEST(MapFiles, NameTheFolderThatIsMissing) {
  const test::TemporaryFolder folder;
  const MapLevels map = grey_map(Projection::lat_long, 1);
  for (const MapFormatInfo& format : map_formats()) {
    EXPECT_THAT(refusal([&] { write_map(folder / "none", "a", map, format.format); }),
                AllOf(HasSubstr("none/a."), HasSubstr("No such file or directory")));
  }
}

BrdfMap small_brdf_map() {
  BrdfMap map = {.values = Grid<glm::vec2>({4, 2}, {0.25F, 1.0F / 255.0F}),
                 .attributes = {{"method", "quadrature"}}};
  map.values(3, 0) = {1.0F, 0.0F};
  return map;
}

TEST(BrdfMapFiles, AreWrittenInEveryFormatThatHoldsThem) {
  for (const MapFormatInfo& format : map_formats()) {
    const test::TemporaryFolder folder;
    const auto write = [&] {
      write_brdf_map(folder / "", "brdf", small_brdf_map(), format.format);
    };
    if (holds_brdf_map(format.format)) {
      write();
      EXPECT_EQ(files_in(folder / ""), (std::set{"brdf." + std::string(format.name)}));
    } else {
      EXPECT_EQ(format.format, MapFormat::hdr);
      EXPECT_THAT(refusal(write),
                  AllOf(HasSubstr("brdf.hdr: not written"), HasSubstr("exr, ktx2 or png")));
      EXPECT_TRUE(fs::is_empty(folder / ""));
    }
  }
}

TEST(BrdfMapFiles, ShowBothChannelsAsTheyAre) {
  const test::TemporaryFolder folder;
  write_brdf_map(folder / "", "brdf", small_brdf_map(), MapFormat::png);
  const auto input = OIIO::ImageInput::open((folder / "brdf.png").string());
  std::vector<unsigned char> values(24);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data()));
  EXPECT_THAT(std::vector(values.begin() + 6, values.begin() + 15),
              ElementsAre(64, 1, 0, 255, 0, 0, 64, 1, 0));
  EXPECT_THAT(input->spec().get_string_attribute("lightproof.transfer"), HasSubstr("none"));
}

TEST(BrdfMapFiles, RefuseValuesThatAreNotFinite) {
  const test::TemporaryFolder folder;
  BrdfMap map = small_brdf_map();
  map.values(1, 1).y = NAN;
  EXPECT_THAT(refusal([&] { write_brdf_map(folder / "", "brdf", map, MapFormat::exr); }),
              HasSubstr("finite values are needed"));
  EXPECT_TRUE(fs::is_empty(folder / ""));
}

}  // namespace
}  // namespace lightproof
