// Points at which inversions err, if they err.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "lightproof/samplers/cdf_table.h"
#include "lightproof/warp/lat_long.h"
#include "tests/samplers/parts.h"

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

/// On both sides of where a sampler's texel changes, along many lines through the square: of each
/// of `count` columns and, at some heights, from one end of each to the other.
template <class Sampler>
std::vector<SquarePoint> points_beside_changes(const Sampler& sampler, std::size_t count) {
  const auto texel = [&](SquarePoint u) {
    const TexelSample sample = sampler.sample(u);
    return std::pair(sample.x, sample.y);
  };
  std::vector<SquarePoint> points;
  for (std::size_t column = 0; column < count; ++column) {
    const double s = (static_cast<double>(column) + 0.5) / static_cast<double>(count);
    for_parts(
        0.0, 1.0,
        [&](double t) {
          return texel({s, t});
        },
        [&](const Part& part) {
          for (const double t : {part.first, part.last}) points.push_back({s, t});
        });
    const double left = static_cast<double>(column) / static_cast<double>(count);
    const double right = static_cast<double>(column + 1) / static_cast<double>(count);
    for (const double t : {0.0, 0.3, 0.7, kLastBelowOne}) {
      for_parts(
          left, right,
          [&](double u) {
            return texel({u, t});
          },
          [&](const Part& part) {
            for (const double u : {part.first, part.last}) points.push_back({u, t});
          });
    }
  }
  return points;
}

}  // namespace lightproof::test
