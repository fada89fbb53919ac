#include "lightproof/recommend/strata.h"

#include "lightproof/core/random.h"

namespace lightproof {

std::vector<SquarePoint> strata_points() {
  const RandomStream stream("recommend/strata", 1);
  std::vector<SquarePoint> points;
  points.reserve(kStrataPoints);
  for (int y = 0; y < kStrataSide; ++y) {
    const double t = (y + stream.point(static_cast<std::uint64_t>(y)).t) / kStrataSide;
    for (int x = 0; x < kStrataSide; ++x) {
      const double s = (x + stream.point(points.size()).s) / kStrataSide;
      points.push_back({s, t});
    }
  }
  return points;
}

namespace {

/// The variance of the values in a square of so many cells along either side.
double variance_in(std::span<const double> values, int x0, int y0, int side) {
  const auto sum = [&](const auto& term) {
    double all = 0.0;
    for (int y = y0; y < y0 + side; ++y) {
      for (int x = x0; x < x0 + side; ++x) {
        all += term(values[static_cast<std::size_t>(y * kStrataSide + x)]);
      }
    }
    return all;
  };
  const double count = static_cast<double>(side) * side;
  const double mean = sum([](double value) { return value; }) / count;
  return sum([mean](double value) { return (value - mean) * (value - mean); }) / (count - 1.0);
}

}  // namespace

StrataVariances variances_inside(std::span<const double> values) {
  StrataVariances variances = {};
  for (std::size_t grid = 0; grid < kStrataGrids; ++grid) {
    const int strata = 1 << grid;
    const int side = kStrataSide / strata;
    for (int j = 0; j < strata; ++j) {
      for (int i = 0; i < strata; ++i) {
        variances[grid] += variance_in(values, i * side, j * side, side) / (strata * strata);
      }
    }
  }
  return variances;
}

std::size_t strata_grid_of(std::uint64_t samples) {
  std::size_t grid = 0;
  while (grid + 1 < kStrataGrids && (std::uint64_t{4} << (2 * grid)) <= samples) ++grid;
  return grid;
}

}  // namespace lightproof
