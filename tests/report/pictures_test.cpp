#include "lightproof/report/pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

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

}  // namespace
}  // namespace lightproof
