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

StrataVariances variances_inside(std::span<const double> values) {
  StrataVariances variances = {};
  for (std::size_t grid = 0; grid < kStrataGrids; ++grid) {
    const int strata = 1 << grid;
    const int side = kStrataSide / strata;
    const double count = static_cast<double>(side) * side;
    double sum = 0.0;
    for (int j = 0; j < strata; ++j) {
      for (int i = 0; i < strata; ++i) {
        double mean = 0.0;
        double square = 0.0;
        for (int y = j * side; y < (j + 1) * side; ++y) {
          for (int x = i * side; x < (i + 1) * side; ++x) {
            mean += values[static_cast<std::size_t>(y * kStrataSide + x)] / count;
          }
        }
        for (int y = j * side; y < (j + 1) * side; ++y) {
          for (int x = i * side; x < (i + 1) * side; ++x) {
            const double off = values[static_cast<std::size_t>(y * kStrataSide + x)] - mean;
            square += off * off;
          }
        }
        sum += square / (count - 1.0);
      }
    }
    variances[grid] = sum / (static_cast<double>(strata) * strata);
  }
  return variances;
}

std::size_t strata_grid_of(std::uint64_t samples) {
  std::size_t grid = 0;
  while (grid + 1 < kStrataGrids && (std::uint64_t{4} << (2 * grid)) <= samples) ++grid;
  return grid;
}

}  // namespace lightproof
