// Positions that are uniform in solid angle: their own distribution, interval by interval, and the
// sine that their density is made of.
#include "lightproof/samplers/texel_positions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lightproof {
namespace {

/// On either side of where the series begins, and of where it is cut.
constexpr int kHeights[] = {1, 2, 3, 17, 31, 32, 33, 255, 256, 257, 1000, 8192};

/// A few rows at both poles and in between.
std::vector<int> rows_of(int height) {
  std::vector<int> rows;
  for (int y = 0; y < height; ++y) {
    const bool at_pole = y < 3 || y >= height - 3;
    if (at_pole || y % (1 + height / 16) == 0 || std::abs(2 * y - height) < 3) rows.push_back(y);
  }
  return rows;
}

/// The share of the solid angle of row y that lies below t: the difference of two cosines as a
/// product, in long double.
double share_below(double t, int y, int height) {
  const long double pi = std::acos(-1.0L);
  const auto rise = [&](long double from, long double to) {
    return std::sin(0.5L * pi * (to - from)) * std::sin(0.5L * pi * (to + from));
  };
  const long double low = static_cast<long double>(y) / height;
  const long double high = (y + 1.0L) / height;
  return static_cast<double>(rise(low, static_cast<long double>(t)) / rise(low, high));
}

/// t is a double below 1, rounded three times at most, and a row has no more than twice the density
/// of an even one.
double share_error(int height) { return 2.0 * height * 3.0 * 0x1p-53 + 0x1p-51; }

TEST(SolidAngleRows, EveryIntervalGetsItsShareOfTheSolidAngle) {
  constexpr int kIntervals = 1000;
  for (const int height : kHeights) {
    const SolidAngleRows rows({2 * height, height});
    for (const int y : rows_of(height)) {
      double last = 0.0;
      for (int i = 1; i <= kIntervals; ++i) {
        const double fraction = static_cast<double>(i) / kIntervals;
        // The last one ends a margin before the row does.
        const double error = share_error(height) + (i == kIntervals ? 4.0 * kCellMargin : 0.0);
        const double share = share_below(rows.position(y, fraction).t, y, height);
        ASSERT_NEAR(share, fraction, error) << "row " << y << " of " << height;
        ASSERT_NEAR(share - last, 1.0 / kIntervals, 2.0 * error) << "row " << y << " of " << height;
        last = share;
      }
    }
  }
}

TEST(SolidAngleRows, TheSineIsThatOfThePosition) {
  for (const int height : kHeights) {
    const SolidAngleRows rows({2 * height, height});
    for (const int y : rows_of(height)) {
      for (const double fraction : {0.0, 1e-9, 1e-6, 0.001, 0.25, 0.5, 0.999, 1.0 - 1e-9, 1.0}) {
        const auto [t, sine] = rows.position(y, fraction);
        ASSERT_GT(t, static_cast<double>(y) / height);
        ASSERT_LT(t, (y + 1.0) / height);
        // t is rounded to 2^-53, near the zenith more than near the nadir.
        const double near = std::min(t, 1.0 - t);
        ASSERT_NEAR(sine / sin_theta(t), 1.0, 0x1p-50 + 0x1p-51 / near)
            << "row " << y << " of " << height << " at " << fraction;
      }
    }
  }
}

TEST(SolidAngleRows, ALineARowIsAllThatTheyKeep) {
  EXPECT_EQ(TexelPositions({64, 32}, DensitySpace::solid_angle).bytes(),
            16 * sizeof(SolidAngleRows::Line));
  EXPECT_EQ(TexelPositions({64, 32}, DensitySpace::texture).bytes(), 0U);
  EXPECT_EQ(TexelPositions({64, 32}, DensitySpace::sine_weighted).bytes(), 0U);
}

// The same texels, and the same masses: only where a sample lies inside them differs.
TEST(TexelPositions, OfTheSineWeightedDensityAreThoseOfTheTextureSpaceDensity) {
  const TexelPositions a({8, 4}, DensitySpace::texture);
  const TexelPositions c({8, 4}, DensitySpace::sine_weighted);
  const TexelSample of_a = a.sample({3, 0, 0.25, 0.75, 0.1});
  const TexelSample of_c = c.sample({3, 0, 0.25, 0.75, 0.1});
  EXPECT_EQ(of_a.at, of_c.at);
  EXPECT_EQ(of_a.pdf.value, of_c.pdf.value);
  EXPECT_EQ(of_c.at.t, 0.75 / 4.0);
}

}  // namespace
}  // namespace lightproof
