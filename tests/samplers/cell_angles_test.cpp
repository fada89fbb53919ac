#include "lightproof/samplers/cell_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lightproof {
namespace {

// Wide cells take the sine and cosine of the whole angle, narrow ones those of a small angle and of
// the cell's edge.
TEST(CellAngles, AreThoseOfThePositionInTheCell) {
  // Each of the four factors, products and sums is rounded to 2^-53, and so is the angle inside the
  // cell; kCellMargin moves what is nearer to an edge.
  constexpr long double kRoundings = 16.0L * 0x1p-53L;
  for (const int count : {1, 2, 3, 37, 255, 256, 257, 2048, 65536}) {
    for (const double turns : {1.0, 0.5}) {
      const CellAngles cells(count, turns, count);
      const long double width = 2.0L * std::numbers::pi_v<long double> * turns / count;
      for (int i = 0; i < 400; ++i) {
        const int cell = static_cast<int>((static_cast<std::int64_t>(i) * 7919) % count);
        const double fraction = i / 400.0;
        const long double angle = width * (cell + static_cast<long double>(fraction));
        const SinCosOfTurns found = cells.at(cell, fraction);
        const long double error = kRoundings * (1.0L + angle) + kCellMargin * width;
        EXPECT_LE(std::abs(found.sin - std::sin(angle)), error) << count << " " << cell;
        EXPECT_LE(std::abs(found.cos - std::cos(angle)), error) << count << " " << cell;
      }
    }
  }
}

// Near the pole a density is divided by the sine.
TEST(CellAngles, SinesInTheFirstCellAreExactRelativeToThemselves) {
  for (const int count : {64, 128, 256, 8192}) {
    const CellAngles rows(count, 0.5, (count + 1) / 2);
    for (int exponent = 1; exponent <= 33; ++exponent) {
      const double fraction = std::ldexp(1.0, -exponent);
      const long double exact =
          std::sin(std::numbers::pi_v<long double> * static_cast<long double>(fraction) / count);
      EXPECT_LE(std::abs(rows.at(0, fraction).sin - exact), 8.0L * 0x1p-53L * exact) << exponent;
    }
  }
}

}  // namespace
}  // namespace lightproof
