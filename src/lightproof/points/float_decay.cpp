#include "lightproof/points/float_decay.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

/// The distance of two numbers of [0,1] on the circle.
double distance_on_circle(double a, double b) {
  const double apart = std::abs(a - b);
  return std::min(apart, 1.0 - apart);
}

template <class T, class Less>
std::uint64_t distinct_of(std::vector<T> values, Less less) {
  std::sort(values.begin(), values.end(), less);
  return static_cast<std::uint64_t>(std::unique(values.begin(), values.end()) - values.begin());
}

template <class Set>
void measure_errors(const Set& set, std::span<const SquarePoint> points, FloatDecay& decay) {
  if constexpr (requires { set.exact_point(0U); }) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const SquarePoint exact = set.exact_point(static_cast<std::uint32_t>(decay.first + i));
      decay.error_s = std::max(decay.error_s, distance_on_circle(points[i].s, exact.s));
      decay.error_t = std::max(decay.error_t, distance_on_circle(points[i].t, exact.t));
    }
  }
}

}  // namespace

FloatDecay float_decay_at(const PointSetInfo& set, std::uint64_t first, std::uint64_t window) {
  assert(first + window <= kMostPoints);
  FloatDecay decay{.set = set.name, .first = first, .window = window};
  const AnyPointSet all = set.prepare(kMostPoints);
  std::vector<SquarePoint> points(static_cast<std::size_t>(window));
  fill_points(all, first, points);
  std::visit([&](const auto& any) { measure_errors(any, points, decay); }, all);
  decay.distinct = distinct_of(
      points, [](SquarePoint a, SquarePoint b) { return a.s < b.s || (a.s == b.s && a.t < b.t); });
  std::vector<double> s;
  std::vector<double> t;
  for (const SquarePoint point : points) {
    s.push_back(point.s);
    t.push_back(point.t);
  }
  decay.distinct_s = distinct_of(std::move(s), std::less<>());
  decay.distinct_t = distinct_of(std::move(t), std::less<>());
  return decay;
}

std::vector<FloatDecay> float_decay(const PointSetInfo& set, std::uint64_t window) {
  std::vector<std::uint64_t> firsts = {0};
  for (std::uint64_t first = 1; first + window <= kMostPoints; first *= 2) firsts.push_back(first);
  if (firsts.back() != kMostPoints - window) firsts.push_back(kMostPoints - window);
  std::vector<FloatDecay> rows(firsts.size());
  parallel_for(rows.size(),
               [&](std::size_t i) { rows[i] = float_decay_at(set, firsts[i], window); });
  return rows;
}

}  // namespace lightproof
