// Points at which inversions err, if they err.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/samplers/cdf_table.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::test {

inline constexpr double kLastBelowOne = 1.0 - 0x1p-53;

/// The knots, with their neighbours, and the ends of the unit interval.
inline std::vector<double> hostile_numbers(CdfKnots knots) {
  std::vector<double> numbers = {0.0, 0x1p-60, 0x1p-31, 0.5, 1.0 - 0x1p-24, kLastBelowOne};
  for (const std::uint32_t knot : knots) {
    const double u = knot * 0x1p-31;
    for (const double v : {std::nextafter(u, 0.0), u, std::nextafter(u, 1.0)}) {
      if (v < 1.0) numbers.push_back(v);
    }
  }
  return numbers;
}

/// Those of the rows with themselves.
inline std::vector<SquarePoint> hostile_points(const CdfTable& table) {
  std::vector<SquarePoint> points;
  const std::vector<double> numbers = hostile_numbers(table.rows());
  for (const double s : numbers) {
    for (const double t : numbers) points.push_back({s, t});
  }
  return points;
}

/// Those of every row's columns, in the row's middle and at its first point.
inline std::vector<SquarePoint> hostile_points_of_rows(const CdfTable& table) {
  std::vector<SquarePoint> points;
  for (int y = 0; y < table.extent().height; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const double low = table.rows()[row] * 0x1p-31;
    const double high = table.rows()[row + 1] * 0x1p-31;
    if (low == high) continue;
    for (const double s : hostile_numbers(table.columns(y))) {
      points.push_back({s, low});
      points.push_back({s, 0.5 * (low + high)});
    }
  }
  return points;
}

}  // namespace lightproof::test
