// Files that are refused: what the message names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/reader.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The message; empty if the file is read.
std::string refusal(const fs::path& file, const ReadOptions& options = {}) {
  try {
    read_environment_map(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ReaderRefuses, WhatIsNoPicture) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder / "none.exr"), AllOf(HasSubstr("none.exr"), HasSubstr("no such")));
  EXPECT_THAT(refusal(folder / ""), HasSubstr("is a folder"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("not a regular file"));
  test::write_bytes(folder / "zero.hdr", "");
  EXPECT_THAT(refusal(folder / "zero.hdr"), AllOf(HasSubstr("zero.hdr"), HasSubstr("0 bytes")));
  test::write_bytes(folder / "text.png", "not a picture at all");
  EXPECT_THAT(refusal(folder / "text.png"), HasSubstr("OpenEXR, Radiance .hdr, PNG or JPEG"));
  test::write_bytes(folder / "magic.exr", "\x76\x2f\x31\x01");
  EXPECT_THAT(refusal(folder / "magic.exr"), HasSubstr("cannot be read as OpenEXR"));
}

TEST(ReaderRefuses, MissingChannelsAndListsThose) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.channels = {"depth.Z", "Y"}});
  EXPECT_THAT(refusal(folder / "a.exr"),
              AllOf(HasSubstr("R, G and B needed"), HasSubstr("depth.Z"), HasSubstr("Y")));
  test::write_integer_picture(folder / "grey.png", {2, 1}, 1, {1, 2}, 8);
  EXPECT_THAT(refusal(folder / "grey.png"), HasSubstr("R, G and B needed"));
}

// Names in a file may hold anything.
TEST(ReaderRefuses, InOneLineWhateverTheFileCallsItsChannels) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", Grid<Rgb>({8, 4}), {.channels = {"up\nand\x1b[1m"}});
  EXPECT_THAT(refusal(folder / "a.exr"),
              AllOf(HasSubstr("found up\\x0aand\\x1b[1m"), Not(HasSubstr("\n"))));
}

TEST(ReaderRefuses, SelectionsThatAreNotThereAndSaysWhatIs) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_exr_file(folder / "a.exr", picture, {.channels = {"sky.R", "sky.G", "sky.B"}});
  EXPECT_THAT(refusal(folder / "a.exr"), HasSubstr("--layer sky"));
  EXPECT_THAT(refusal(folder / "a.exr", {.selection = {.layer = "sea"}}),
              AllOf(HasSubstr("sea.R, sea.G and sea.B needed"), HasSubstr("sky.R, sky.G")));
  EXPECT_THAT(refusal(folder / "a.exr", {.selection = {.channels = {"Y"}}}),
              HasSubstr("channel Y needed"));
  EXPECT_THAT(refusal(folder / "a.exr", {.selection = {.part = 1}}), HasSubstr("one part, 0"));
  test::write_two_part_exr(folder / "two.exr", picture, picture);
  EXPECT_THAT(refusal(folder / "two.exr", {.selection = {.part = 2}}), HasSubstr("0 to 1"));
  test::write_integer_picture(folder / "grey.png", {2, 1}, 1, {1, 2}, 8);
  EXPECT_THAT(refusal(folder / "grey.png"), HasSubstr("--channels Y reads it as grey"));
  test::write_hdr_file(folder / "a.hdr", "-Y 2 +X 4", std::vector<test::Rgbe>(8, {200, 1, 1, 128}));
  EXPECT_THAT(refusal(folder / "a.hdr", {.selection = {.part = 1}}), HasSubstr("no part 1"));
  EXPECT_THAT(refusal(folder / "a.hdr", {.selection = {.channels = {"A"}}}),
              HasSubstr("found R, G, B"));
}

TEST(ReaderRefuses, LuminanceByWeightsThatAreNotPositive) {
  const TemporaryFolder folder;
  test::write_exr_file(
      folder / "a.exr", test::numbered_picture({8, 4}),
      {.chromaticities = {{.7347F, .2653F, 0.0F, 1.0F, .0001F, -.077F, .32168F, .33767F}}});
  EXPECT_EQ(refusal(folder / "a.exr"), "");
  EXPECT_THAT(refusal(folder / "a.exr", {.luminance = LuminanceChoice::file}),
              AllOf(HasSubstr("AP0"), HasSubstr("-0.0721"), HasSubstr("--luminance")));
}

TEST(ReaderRefuses, KindsOfExrThatAreNoFlatRgb) {
  const TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({8, 4});
  test::write_deep_exr(folder / "deep.exr", {8, 4});
  EXPECT_THAT(refusal(folder / "deep.exr"), HasSubstr("deep samples"));
  test::write_luminance_chroma_exr(folder / "yc.exr", {8, 4});
  EXPECT_THAT(refusal(folder / "yc.exr"),
              AllOf(HasSubstr("R, G and B needed"), HasSubstr("--to-rgb")));
  test::write_exr_file(folder / "white.exr", picture,
                       {.channels = {"BY", "RY", "Y"},
                        .chromaticities = {{0.64F, 0.33F, 0.3F, 0.6F, 0.15F, 0.06F, 0.31F, 0.0F}}});
  EXPECT_THAT(refusal(folder / "white.exr", {.allow = {.to_rgb = true}}),
              HasSubstr("cannot be read as OpenEXR: Bad chromaticities"));
  test::write_uint_exr(folder / "uint.exr", {8, 4});
  EXPECT_THAT(refusal(folder / "uint.exr"), HasSubstr("half or float needed"));
  test::write_exr_file(folder / "xyz.exr", picture, {.xyz = true});
  EXPECT_THAT(refusal(folder / "xyz.exr"), AllOf(HasSubstr("CIE XYZ"), HasSubstr("--to-rgb")));
  test::write_exr_file(folder / "crop.exr", picture, {.missing_columns = 2});
  EXPECT_THAT(refusal(folder / "crop.exr"),
              AllOf(HasSubstr("data window (8 x 4"), HasSubstr("display window (10 x 4"),
                    HasSubstr("--pad")));
}

TEST(ReaderRefuses, CubeMapsWhateverThePreset) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "cube.exr", test::numbered_picture({4, 24}),
                       {.envmap = test::Envmap::cube});
  EXPECT_THAT(refusal(folder / "cube.exr"), HasSubstr("cube map"));
  EXPECT_THAT(refusal(folder / "cube.exr", {.preset = Preset::z_up, .any_aspect = true}),
              HasSubstr("cube map"));
}

TEST(ReaderRefuses, QuarterTurnsOfExif) {
  const TemporaryFolder folder;
  test::write_integer_picture(folder / "a.jpg", {16, 8}, 3, std::vector<unsigned>(16 * 8 * 3, 99),
                              8, 6);
  EXPECT_THAT(refusal(folder / "a.jpg"), HasSubstr("orientation 6"));
}

TEST(ReaderRefuses, BadTexelsByCountPositionAndFlag) {
  const TemporaryFolder folder;
  const float infinity = std::numeric_limits<float>::infinity();
  const struct {
    float value;
    const char* kind;
  } cases[] = {{-1e-3F, "negative values"},
               {std::numeric_limits<float>::quiet_NaN(), "NaN"},
               {infinity, "infinite values"},
               {-infinity, "infinite values"}};
  for (const auto& [value, kind] : cases) {
    Grid<Rgb> picture = test::numbered_picture({8, 4});
    picture(6, 1).b = value;
    picture(2, 3).r = value;
    picture(2, 3).g = value;
    test::write_exr_file(folder / "bad.exr", picture);
    EXPECT_THAT(refusal(folder / "bad.exr"),
                AllOf(HasSubstr("bad.exr"), HasSubstr("2 texels with " + std::string(kind)),
                      HasSubstr("column 6, row 1"), HasSubstr("--repair")));
    EXPECT_EQ(refusal(folder / "bad.exr", {.repair = Repair::zero}), "");
  }
}

TEST(ReaderRefuses, OtherAspectsAndNamesTheFlag) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "a.exr", test::numbered_picture({9, 4}));
  EXPECT_THAT(refusal(folder / "a.exr"),
              AllOf(HasSubstr("9 x 4"), HasSubstr("--any-aspect"), Not(HasSubstr("pbrt-v4"))));
  EXPECT_EQ(refusal(folder / "a.exr", {.any_aspect = true}), "");

  test::write_exr_file(folder / "square.exr", test::numbered_picture({8, 8}));
  EXPECT_THAT(refusal(folder / "square.exr"), HasSubstr("--preset pbrt-v4"));
  EXPECT_EQ(refusal(folder / "square.exr", {.preset = Preset::pbrt_v4}), "");

  test::write_exr_file(folder / "wide.exr", test::numbered_picture({8, 4}));
  EXPECT_THAT(refusal(folder / "wide.exr", {.preset = Preset::pbrt_v4, .any_aspect = true}),
              AllOf(HasSubstr("8 x 4"), HasSubstr("square"), HasSubstr("--preset")));

  test::write_exr_file(folder / "row.exr", test::numbered_picture({8, 1}));
  EXPECT_THAT(refusal(folder / "row.exr", {.preset = Preset::openexr, .any_aspect = true}),
              HasSubstr("at least 2 x 2"));
}

TEST(ReaderRefuses, SizesBeyondTheLimitBeforeReading) {
  const TemporaryFolder folder;
  for (const char* resolution : {"-Y 16385 +X 32770", "-Y 4 +X 32769", "-Y 2000000 +X 4000000"}) {
    test::write_hdr_file(folder / "huge.hdr", resolution, {{1, 1, 1, 128}});
    EXPECT_THAT(refusal(folder / "huge.hdr"), HasSubstr("32768 x 16384")) << resolution;
  }
}

TEST(ReaderRefuses, BlackMaps) {
  const TemporaryFolder folder;
  test::write_exr_file(folder / "black.exr", Grid<Rgb>({8, 4}));
  EXPECT_THAT(refusal(folder / "black.exr"), HasSubstr("every texel is black"));
  test::write_exr_file(folder / "denormal.exr", Grid<Rgb>({8, 4}, Rgb(1e-39F)));
  EXPECT_THAT(refusal(folder / "denormal.exr"), HasSubstr("every texel is black"));
  test::write_exr_file(folder / "negative.exr", Grid<Rgb>({8, 4}, Rgb(-1.0F)));
  EXPECT_THAT(refusal(folder / "negative.exr", {.repair = Repair::zero}),
              HasSubstr("every texel is black"));
}

/// Of nodes the last column is the first: what it holds beside is no texel.
TEST(ReaderRefuses, PicturesWhoseLightIsInNoTexel) {
  const TemporaryFolder folder;
  Grid<Rgb> picture({9, 5});
  picture(8, 2) = Rgb(3.0F);
  test::write_exr_file(folder / "seam.exr", picture);
  for (const Repair repair : {Repair::refuse, Repair::zero}) {
    EXPECT_THAT(
        refusal(folder / "seam.exr", {.preset = Preset::openexr, .repair = repair}),
        HasSubstr("every texel is black: the picture's light, up to 3, is in pixels that no "
                  "texel of preset openexr shows"));
  }
  picture(8, 2) = Rgb(std::numeric_limits<float>::infinity());
  picture(8, 3) = Rgb(3.0F);
  test::write_exr_file(folder / "infinite.exr", picture);
  EXPECT_THAT(
      refusal(folder / "infinite.exr", {.preset = Preset::openexr, .repair = Repair::clamp}),
      HasSubstr("every texel is black"));
}

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = count; i-- > 0;) {
    number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return number;
}

std::string number_bytes(std::uint64_t number, std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
  return bytes;
}

/// An OpenEXR file of so many chunks with another first one.
std::string with_first_chunk(std::string exr, std::size_t chunks, bool is_tile,
                             const std::string& bytes) {
  // The table of places ends where the first chunk begins.
  std::size_t table = 8;
  while (number_at(exr, table, 8) != table + 8 * chunks) ++table;
  // Behind the row, or column and row of the tile and of its level.
  const std::size_t size_at = table + 8 * chunks + (is_tile ? 16 : 4);
  const std::uint64_t size = number_at(exr, size_at, 4);
  exr.replace(size_at, 4 + size, number_bytes(bytes.size(), 4) + bytes);
  for (std::size_t i = 1; i < chunks; ++i) {
    const std::size_t at = table + 8 * i;
    exr.replace(at, 8, number_bytes(number_at(exr, at, 8) + bytes.size() - size, 8));
  }
  return exr;
}

/// So many bytes of black pixels in one of the first four compressions.
std::string compressed_black(std::size_t compression, std::size_t count) {
  if (compression == 0) return std::string(count, '\0');
  // Differences of bytes, plus 128.
  std::string differences(count, '\x80');
  differences[0] = '\0';
  if (compression == 1) {
    std::string runs(2, '\0');  // a byte once
    for (std::size_t left = count - 1; left > 0;) {
      const std::size_t run = std::min<std::size_t>(left, 128);
      runs += {static_cast<char>(run - 1), '\x80'};
      left -= run;
    }
    return runs;
  }
  std::string bytes(compressBound(count), '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                     reinterpret_cast<const Bytef*>(differences.data()), count),
            Z_OK);
  return bytes.substr(0, size);
}

// OpenEXR itself reads such files, and shows in the place of the missing pixels what its memory
// held.
TEST(ReaderRefuses, ChunksThatHoldLessThanTheirPixels) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.exr";
  constexpr std::size_t kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  for (std::size_t i = 0; i < test::kExrCompressions.size(); ++i) {
    for (const unsigned tile : {0U, 16U}) {
      SCOPED_TRACE(testing::Message() << test::kExrCompressions[i] << " tile " << tile);
      test::write_compressed_exr(file, test::numbered_picture({64, 32}), i, false, tile);
      const std::string exr = test::bytes_of(file);
      const std::size_t rows = tile > 0 ? tile : std::min<std::size_t>(kRows[i], 32);
      const std::size_t chunks = tile > 0 ? 8 : 32 / rows;
      const auto with = [&](const std::string& bytes) {
        test::write_bytes(file, with_first_chunk(exr, chunks, tile > 0, bytes));
        return refusal(file);
      };
      EXPECT_THAT(with(""), HasSubstr("a.exr: "));
      if (i > 3) continue;
      const std::size_t needed = 12 * rows * (tile > 0 ? tile : 64);
      EXPECT_EQ(with(compressed_black(i, needed)), "");
      EXPECT_THAT(with(compressed_black(i, needed - 12)), HasSubstr("a.exr: "));
    }
  }
}

TEST(ReaderRefuses, WindowsByTheFlagsThatHelp) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.exr";
  test::write_exr_file(file, test::numbered_picture({8, 4}), {.missing_columns = 4});
  EXPECT_THAT(refusal(file), AllOf(HasSubstr("--pad"), Not(HasSubstr("--crop"))));
  test::write_exr_file(file, test::numbered_picture({8, 4}), {.missing_columns = -2});
  EXPECT_THAT(refusal(file), AllOf(HasSubstr("--crop"), Not(HasSubstr("--pad"))));
  test::write_exr_file(file, test::numbered_picture({8, 4}), {.missing_columns = 20'000});
  EXPECT_THAT(refusal(file, {.any_aspect = true, .allow = {.pad = true}}),
              HasSubstr("its header is damaged"));
  // The first row and column of the display window moved to 1, 1: something is missing on one side,
  // and something too much on the other.
  test::write_exr_file(file, test::numbered_picture({8, 4}), {.missing_columns = 1});
  std::string bytes = test::bytes_of(file);
  bytes[bytes.find("displayWindow") + 14 + 6 + 4] = 1;
  test::write_bytes(file, bytes);
  EXPECT_THAT(refusal(file), AllOf(HasSubstr("--pad"), HasSubstr("--crop")));
  EXPECT_EQ(refusal(file, {.allow = {.pad = true, .crop = true}}), "");
}

/// One valid file of every format, 64 x 32.
std::vector<fs::path> valid_files(const TemporaryFolder& folder) {
  const Grid<Rgb> picture = test::numbered_picture({64, 32});
  std::vector<unsigned> values;
  const RandomStream stream("noise", 1);
  for (unsigned i = 0; i < 64 * 32 * 3; ++i) {
    values.push_back(static_cast<unsigned>(256.0 * stream.point(i).s));
  }
  test::write_exr_file(folder / "a.exr", picture);
  test::write_hdr_file(folder / "a.hdr", "-Y 32 +X 64",
                       std::vector<test::Rgbe>(64 * 32, {128, 64, 32, 129}));
  test::write_integer_picture(folder / "a.png", {64, 32}, 3, values, 8);
  test::write_integer_picture(folder / "a.jpg", {64, 32}, 3, values, 8);
  return {folder / "a.exr", folder / "a.hdr", folder / "a.png", folder / "a.jpg"};
}

TEST(ReaderRefuses, FilesCutOffAnywhere) {
  const TemporaryFolder folder;
  for (const fs::path& file : valid_files(folder)) {
    const std::string bytes = test::bytes_of(file);
    ASSERT_EQ(refusal(file), "");
    for (const double share : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97}) {
      const auto kept = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
      test::write_bytes(file, bytes.substr(0, kept));
      EXPECT_THAT(refusal(file), HasSubstr(file.filename().string() + ": ")) << share;
    }
  }
}

// Cameras store a thumbnail, a JPEG of its own, ahead of the picture and append films to it.
TEST(ReaderRefuses, JpegsCutOffBehindTheirThumbnail) {
  const TemporaryFolder folder;
  const fs::path file = valid_files(folder).back();
  const std::string bytes = test::bytes_of(file);
  const std::string thumbnail = std::string("\xff\xe2\x00\x06\xff\xd9\xff\xd9", 8);
  const std::string with_thumbnail = bytes.substr(0, 2) + thumbnail + bytes.substr(2);
  test::write_bytes(file, with_thumbnail + std::string(5000, 'f'));
  EXPECT_EQ(refusal(file), "");
  test::write_bytes(file, with_thumbnail.substr(0, with_thumbnail.size() / 2));
  EXPECT_THAT(refusal(file), HasSubstr("cut off"));
}

// Whether a damaged file is read or refused depends on the damage; nothing but InputError may come
// out of it.
TEST(ReaderRefuses, DamagedFilesWithoutAnythingWorse) {
  const TemporaryFolder folder;
  for (const fs::path& file : valid_files(folder)) {
    const std::string bytes = test::bytes_of(file);
    const RandomStream stream("damage", 1);
    int refused = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
      std::string damaged = bytes;
      const SquarePoint u = stream.point(i);
      const std::size_t reach =
          i % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);
      const auto at = static_cast<std::size_t>(u.s * static_cast<double>(reach));
      damaged[at] = static_cast<char>(static_cast<int>(u.t * 256.0));
      test::write_bytes(file, damaged);
      refused += refusal(file).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 0) << file;
  }
}

}  // namespace
}  // namespace lightproof
