#include "lightproof/image/writer.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>

#include "lightproof/core/error.h"
#include "lightproof/image/reader.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

template <class Write>
std::string refusal(const Write& write) {
  try {
    write();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::vector<unsigned char> png_values(const fs::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  std::vector<unsigned char> values(static_cast<std::size_t>(input->spec().image_pixels()) * 3);
  input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data());
  return values;
}

TEST(WriteExr, KeepsEveryBit) {
  const test::TemporaryFolder folder;
  Grid<Rgb> picture = test::numbered_picture({8, 4});
  picture(3, 1) = {1e-30F, 3e38F, 1.0F + std::numeric_limits<float>::epsilon()};
  write_exr(folder / "a.exr", picture);
  const EnvironmentMap map = read_environment_map(folder / "a.exr");
  EXPECT_TRUE(std::ranges::equal(flip_rows(map.radiance).values(), picture.values()));
}

TEST(WriteExr, GivesTheSameBytesAgain) {
  const test::TemporaryFolder folder;
  write_exr(folder / "a.exr", test::numbered_picture({8, 4}));
  const std::string bytes = test::bytes_of(folder / "a.exr");
  EXPECT_THAT(bytes, Not(HasSubstr("capDate"))) << "a time";
  write_exr(folder / "a.exr", test::numbered_picture({8, 4}));
  EXPECT_EQ(test::bytes_of(folder / "a.exr"), bytes);
}

TEST(WriteExr, RefusesValuesThatAreNotFinite) {
  const test::TemporaryFolder folder;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Grid<Rgb> picture = test::numbered_picture({8, 4});
    picture(0, 2).g = bad;
    EXPECT_THAT(refusal([&] { write_exr(folder / "bad.exr", picture); }),
                AllOf(HasSubstr("bad.exr"), HasSubstr("column 0, row 2")));
    EXPECT_FALSE(fs::exists(folder / "bad.exr"));
  }
}

TEST(WritePng, QuantisesAndClamps) {
  const test::TemporaryFolder folder;
  Grid<Rgb> picture({2, 2});
  picture(0, 0) = {0.0F, 1.0F, 0.5F};
  picture(1, 0) = {-1.0F, 2.0F, std::numeric_limits<float>::quiet_NaN()};
  picture(0, 1) = {10.4F / 255, 10.6F / 255, std::numeric_limits<float>::infinity()};
  picture(1, 1) = {1.0F / 255, 0.6F / 255, 0.4F / 255};
  write_png(folder / "a.png", picture);
  const std::vector<unsigned char> expected = {0, 255, 128, 0, 255, 0, 10, 11, 255, 1, 1, 0};
  EXPECT_EQ(png_values(folder / "a.png"), expected);
}

TEST(WritePng, GivesTheBytesOfPngBytes) {
  const test::TemporaryFolder folder;
  const Grid<Rgb> picture({5, 3}, Rgb(0.25F));
  write_png(folder / "a.png", picture);
  EXPECT_EQ(test::bytes_of(folder / "a.png"), png_bytes(picture));
  EXPECT_EQ(png_bytes(picture).substr(1, 3), "PNG");
}

TEST(Writers, NameTheMissingFolder) {
  const test::TemporaryFolder folder;
  const Grid<Rgb> picture({2, 2});
  EXPECT_THAT(refusal([&] { write_exr(folder / "none" / "a.exr", picture); }),
              AllOf(HasSubstr("none/a.exr"), HasSubstr("No such file or directory")));
  EXPECT_THAT(refusal([&] { write_png(folder / "none" / "a.png", picture); }),
              AllOf(HasSubstr("none/a.png"), HasSubstr("No such file or directory")));
}

/// Files of this process end at so many bytes while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_ = {};
  void (*handler_)(int) = nullptr;
};

TEST(Writers, LeaveNothingBehindWhenTheDiskIsFull) {
  const test::TemporaryFolder folder;
  const Grid<Rgb> picture = test::numbered_picture({256, 128});
  std::string exr;
  std::string png;
  {
    const FileSizeLimit full(64);
    exr = refusal([&] { write_exr(folder / "a.exr", picture); });
    png = refusal([&] { write_png(folder / "a.png", picture); });
  }
  EXPECT_THAT(exr, AllOf(HasSubstr("a.exr"), HasSubstr("File too large")));
  EXPECT_THAT(png, AllOf(HasSubstr("a.png"), HasSubstr("File too large")));
  EXPECT_TRUE(fs::is_empty(folder / ""));
}

TEST(FlipRows, ReversesRowsOnly) {
  const Grid<Rgb> picture = test::numbered_picture({3, 5});
  const Grid<Rgb> flipped = flip_rows(picture);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 3; ++x) EXPECT_EQ(flipped(x, y), picture(x, 4 - y));
  }
}

}  // namespace
}  // namespace lightproof
