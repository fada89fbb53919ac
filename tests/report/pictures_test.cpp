#include "lightproof/report/pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lightproof/warp/cube.h"

namespace lightproof {
namespace {

double brightness(Rgb c) { return static_cast<double>(c.r + c.g + c.b); }

TEST(DivergingColour, IsWhiteAtZeroAndFadesEvenlyToBothSides) {
  EXPECT_EQ(diverging_colour(0.0, 2.0), Rgb(1.0F));
  for (const double v : {0.5, 1.0, 1.5, 2.0}) {
    const Rgb high = diverging_colour(v, 2.0);
    const Rgb low = diverging_colour(-v, 2.0);
    EXPECT_GT(high.r, high.b) << v;
    EXPECT_GT(low.b, low.r) << v;
    // A colour's distance from white is the same share of the way on either side.
    const double share_high =
        (3.0 - brightness(high)) / (3.0 - brightness(diverging_colour(2.0, 2.0)));
    const double share_low =
        (3.0 - brightness(low)) / (3.0 - brightness(diverging_colour(-2.0, 2.0)));
    EXPECT_NEAR(share_high, v / 2.0, 1e-6);  // float colours
    EXPECT_NEAR(share_low, v / 2.0, 1e-6);
  }
}

TEST(DivergingColour, ClampsAndMarksWhatIsNotFinite) {
  EXPECT_EQ(diverging_colour(9.0, 2.0), diverging_colour(2.0, 2.0));
  EXPECT_EQ(diverging_colour(-9.0, 2.0), diverging_colour(-2.0, 2.0));
  EXPECT_EQ(diverging_colour(std::nan(""), 2.0), Rgb(0.5F));
}

TEST(CommonRange, CoversAllPicturesWithARoundNumber) {
  Grid<double> a(Extent{10, 10}, 0.03);
  Grid<double> b(Extent{10, 10}, -0.13);
  b(3, 3) = 1000.0;  // one of 200 may lie beyond
  b(4, 4) = std::nan("");
  const std::array<const Grid<double>*, 2> both = {&a, &b};
  EXPECT_DOUBLE_EQ(common_range(both), 0.2);
  const Grid<double> zero(Extent{2, 2}, 0.0);
  const std::array<const Grid<double>*, 1> none = {&zero};
  EXPECT_DOUBLE_EQ(common_range(none), 1.0);
}

TEST(ToneMapping, PutsTheMeansWhereItSays) {
  Grid<Rgb> picture(Extent{2, 1}, Rgb(1.0F));
  picture(1, 0) = Rgb(4.0F);
  EXPECT_NEAR(grey_exposure(picture), 0.18 / 2.0, 1e-9);
  EXPECT_NEAR(mean_exposure(picture), 0.35 / 2.5, 1e-9);
  picture(0, 0) = Rgb(0.0F);  // unlit pixels do not count
  EXPECT_NEAR(mean_exposure(picture), 0.35 / 4.0, 1e-9);
  EXPECT_EQ(grey_exposure(Grid<Rgb>(Extent{1, 1}, Rgb(0.0F))), 1.0);
}

TEST(ToneMapping, EncodesSrgbAndClips) {
  Grid<Rgb> picture(Extent{2, 1});
  picture(0, 0) = Rgb(0.18F, 0.001F, 2.0F);
  picture(1, 0) = Rgb(std::nanf(""), HUGE_VALF, -1.0F);
  const Grid<Rgb> mapped = tone_mapped(picture, 1.0);
  // IEC 61966-2-1, to float precision of the input.
  EXPECT_NEAR(static_cast<double>(mapped(0, 0).r), 0.46135613, 1e-6);
  EXPECT_NEAR(static_cast<double>(mapped(0, 0).g), 0.01292, 1e-6);
  EXPECT_EQ(mapped(0, 0).b, 1.0F);
  EXPECT_EQ(mapped(1, 0), Rgb(0.0F, 1.0F, 0.0F));
}

TEST(Shrunk, AveragesWholeBlocksAndKeepsTheEdge) {
  Grid<Rgb> picture(Extent{5, 2}, Rgb(1.0F));
  picture(0, 0) = Rgb(5.0F);
  picture(4, 1) = Rgb(3.0F);
  const Grid<Rgb> small = shrunk(picture, 3);
  EXPECT_EQ(small.extent(), (Extent{3, 1}));
  EXPECT_EQ(small(0, 0), Rgb(2.0F));
  EXPECT_EQ(small(2, 0), Rgb(2.0F));  // a block of one column
  EXPECT_EQ(shrunk(picture, 5).extent(), picture.extent());
}

// The places where an edge of the cross is an edge of the cube, by the directions of warp/cube.h.
TEST(UnfoldedCube, JoinsFacesWhereTheCubeDoes) {
  constexpr int kSize = 3;
  std::vector<Grid<Rgb>> faces;
  for (const CubeFace face : kCubeFaces) {
    faces.emplace_back(Extent{kSize, kSize});
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        faces.back()(x, y) = Rgb(direction_of(CubeTexel{face, x, y}, kSize));
      }
    }
  }
  const Grid<Rgb> cross = unfolded_cube(faces, Rgb(9.0F));
  ASSERT_EQ(cross.extent(), (Extent{4 * kSize, 3 * kSize}));
  // Centres on either side of an edge are as near as two texels beside each other in a face can be:
  // at an angle of 2 atan(1 / (2 (size - 1/2))) at the most, here 41 degrees, its chord 0.74.
  const auto distance = [&](int x0, int y0, int x1, int y1) {
    return static_cast<double>(glm::length(cross(x0, y0) - cross(x1, y1)));
  };
  for (int i = 0; i < kSize; ++i) {
    for (const int edge : {kSize, 2 * kSize, 3 * kSize}) {
      EXPECT_LT(distance(edge - 1, kSize + i, edge, kSize + i), 0.74);
    }
    EXPECT_LT(distance(kSize + i, kSize - 1, kSize + i, kSize), 0.74);
    EXPECT_LT(distance(kSize + i, 2 * kSize - 1, kSize + i, 2 * kSize), 0.74);
  }
  EXPECT_EQ(cross(0, 0), Rgb(9.0F));
  EXPECT_EQ(cross(4 * kSize - 1, 3 * kSize - 1), Rgb(9.0F));
}

}  // namespace
}  // namespace lightproof
