#include "lightproof/points/discrepancy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace lightproof {
namespace {

/// The largest difference over the boxes that hold the first of the points, in order of s: those
/// whose t are `heights`, ascending, with 0 before and 1 behind them. Boxes shut to the right at
/// the last of these points, or are open up to the next one.
double largest_difference(std::span<const double> heights, double last_s, double next_s,
                          double share) {
  double largest = 0.0;
  for (std::size_t j = 0; j + 1 < heights.size(); ++j) {
    const double inside = static_cast<double>(j) * share;
    const double shut = std::abs(inside - last_s * heights[j]);
    const double open = std::abs(inside - next_s * heights[j + 1]);
    largest = std::max({largest, shut, open});
  }
  return largest;
}

}  // namespace

double star_discrepancy(std::span<const SquarePoint> points) {
  assert(!points.empty());
  std::vector<SquarePoint> by_s(points.begin(), points.end());
  std::sort(by_s.begin(), by_s.end(), [](SquarePoint a, SquarePoint b) { return a.s < b.s; });
  const double share = 1.0 / static_cast<double>(by_s.size());
  std::vector<double> heights = {0.0, 1.0};
  heights.reserve(by_s.size() + 2);
  double last_s = 0.0;
  double largest = 0.0;
  for (const SquarePoint point : by_s) {
    largest = std::max(largest, largest_difference(heights, last_s, point.s, share));
    heights.insert(std::upper_bound(heights.begin(), heights.end() - 1, point.t), point.t);
    last_s = point.s;
  }
  return std::max(largest, largest_difference(heights, last_s, 1.0, share));
}

double l2_star_discrepancy(std::span<const SquarePoint> points) {
  assert(!points.empty());
  const double n = static_cast<double>(points.size());
  double single = 0.0;
  double pairs = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [s, t] = points[i];
    single += (1.0 - s * s) * (1.0 - t * t);
    double later = 0.0;
    for (const SquarePoint other : points.subspan(i + 1)) {
      later += (1.0 - std::max(s, other.s)) * (1.0 - std::max(t, other.t));
    }
    pairs += (1.0 - s) * (1.0 - t) + 2.0 * later;
  }
  // Cancellation may leave a square a rounding below 0.
  return std::sqrt(std::max(0.0, 1.0 / 9.0 - single / (2.0 * n) + pairs / (n * n)));
}

}  // namespace lightproof
