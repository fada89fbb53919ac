// Radiance .hdr pictures, read back by our own reader and by OpenImageIO.
#include "lightproof/image/radiance_writer.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/random.h"
#include "lightproof/image/image_file.h"
#include "lightproof/image/stored_value.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

/// What is stored of a picture.
Grid<Rgb> stored(const Grid<Rgb>& picture) {
  Grid<Rgb> kept(picture.extent());
  std::ranges::transform(picture.values(), kept.values().begin(),
                         [](Rgb rgb) { return rgb_of(rgbe_of(rgb)); });
  return kept;
}

Grid<Rgb> random_picture(Extent extent) {
  const RandomStream stream("radiance-writer", extent.count());
  Grid<Rgb> picture(extent);
  std::uint64_t i = 0;
  for (Rgb& rgb : picture.values()) {
    const SquarePoint a = stream.point(i++);
    rgb = Rgb(a.s, a.t, a.s * a.t) * static_cast<float>(std::exp2(20.0 * a.t));
  }
  return picture;
}

class RadianceWriter : public testing::Test {
 protected:
  fs::path write(const std::string& bytes) const {
    test::write_bytes(folder_ / "a.hdr", bytes);
    return folder_ / "a.hdr";
  }

  void expect_read_back(const Grid<Rgb>& picture, const Attributes& attributes = {}) const {
    const fs::path file = write(radiance_bytes(picture, attributes));
    const Grid<Rgb> expected = stored(picture);
    ImageFile ours(file);
    const Grid<Rgb> read = ours.read_pixels();
    ASSERT_EQ(read.extent(), picture.extent());
    EXPECT_TRUE(std::ranges::equal(read.values(), expected.values()));
    EXPECT_THAT(ours.header().notes, IsEmpty());
    EXPECT_EQ(ours.header().orientation, "");

    const auto input = OIIO::ImageInput::open(file.string());
    ASSERT_TRUE(input) << OIIO::geterror();
    Grid<Rgb> others(picture.extent());
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, others.values().data()))
        << input->geterror();
    EXPECT_TRUE(std::ranges::equal(others.values(), expected.values()));
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(RadianceWriter, IsReadBackWhateverTheSize) {
  for (const Extent extent : {Extent{1, 1},
                              {7, 3},
                              {8, 3},
                              {9, 1},
                              {127, 2},
                              {128, 2},
                              {129, 2},
                              {255, 2},
                              {256, 2},
                              {257, 2},
                              {1, 40},
                              {1000, 5}}) {
    expect_read_back(random_picture(extent));
  }
}

TEST_F(RadianceWriter, IsReadBackBeyondTheWidthOfPlanes) {
  expect_read_back(random_picture({32767, 1}));
  expect_read_back(random_picture({32768, 1}));
}

// Runs of every length up to beyond the longest code, between values that do not repeat.
TEST_F(RadianceWriter, IsReadBackWithRunsOfEveryLength) {
  for (const int lead : {0, 1, 2, 127, 128, 129}) {
    Grid<Rgb> picture({400, 260});
    for (int y = 0; y < 260; ++y) {
      for (int x = 0; x < 400; ++x) {
        const bool in_run = x >= lead && x < lead + y;
        picture(x, y) = in_run ? Rgb(3.0F) : Rgb(128.0F + static_cast<float>(x % 97));
      }
    }
    expect_read_back(picture);
  }
}

TEST_F(RadianceWriter, CodesRuns) {
  const std::string bytes = radiance_bytes(Grid<Rgb>({1000, 1}, Rgb(0.5F)));
  const std::string pixels = bytes.substr(bytes.find("+X 1000\n") + 8);
  // Four bytes, then in each plane 1000 = 7 * 127 + 111 bytes as 8 runs of two bytes.
  EXPECT_EQ(pixels.size(), 4U + 4U * 16U);
}

TEST_F(RadianceWriter, KeepsBlackAndBrightBesideEachOther) {
  Grid<Rgb> picture({16, 2}, Rgb(0.0F));
  picture(3, 0) = Rgb(1e30F, 0.0F, 1e29F);
  picture(4, 1) = Rgb(1e-30F);
  expect_read_back(picture);
}

TEST_F(RadianceWriter, SaysHowItWasMade) {
  const std::string bytes =
      radiance_bytes(Grid<Rgb>({8, 1}), {{"method", "quadrature"}, {"source", "two\nlines"}});
  EXPECT_EQ(bytes.substr(0, bytes.find('\n')), "#?RADIANCE");
  EXPECT_THAT(bytes,
              HasSubstr("\n# lightproof.method=quadrature\n# lightproof.source=two lines\n"));
  EXPECT_THAT(bytes, HasSubstr("\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n"));
}

/// Whether a reader that takes lines in pieces of so many bytes comes upon an empty one before the
/// header's end.
bool has_empty_piece(std::string_view header, std::size_t piece) {
  for (std::size_t begin = 0; begin < header.size();) {
    const std::size_t length = header.find('\n', begin) - begin;
    if (length > 0 && length % piece == 0) return true;
    begin += length + 1;
  }
  return false;
}

// Pieces of 127 bytes are those of rgbe.c, 128 those of OpenImageIO.
TEST_F(RadianceWriter, IsReadBackWithAttributesOfEveryLength) {
  const Grid<Rgb> picture({8, 1}, Rgb(1.0F));
  for (std::size_t length = 100; length < 250; ++length) {
    SCOPED_TRACE(length);
    const Attributes attributes = {{"method", std::string(length, 'x')}};
    expect_read_back(picture, attributes);
    const std::string bytes = radiance_bytes(picture, attributes);
    const std::string header = bytes.substr(0, bytes.find("\n\n") + 2);
    EXPECT_FALSE(has_empty_piece(header, 127) || has_empty_piece(header, 128));
  }
}

TEST_F(RadianceWriter, NamesItsPrimaries) {
  const Grid<Rgb> picture({8, 1});
  const auto primaries = [&](const std::optional<Chromaticities>& given) {
    const ImageFile file(write(radiance_bytes(picture, {}, given)));
    return std::string(name_of(*file.header().chromaticities));
  };
  EXPECT_EQ(primaries(std::nullopt), "Rec. 709");
  EXPECT_EQ(
      primaries(Chromaticities{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}),
      "ACEScg");
}

TEST_F(RadianceWriter, GivesTheSameBytesAgain) {
  const Grid<Rgb> picture = random_picture({100, 50});
  EXPECT_EQ(radiance_bytes(picture), radiance_bytes(picture));
}

}  // namespace
}  // namespace lightproof
