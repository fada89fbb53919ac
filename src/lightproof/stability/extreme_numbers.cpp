#include "lightproof/stability/extreme_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightproof {
namespace {

constexpr std::uint32_t kNumbers = 1U << 24U;
constexpr std::size_t kBatch = 1 << 14;

SquarePoint point_of(Coordinate coordinate, double number, double other) {
  return coordinate == Coordinate::s ? SquarePoint{number, other} : SquarePoint{other, number};
}

/// Calls visit(points) for all numbers, some at a time.
template <class Visit>
void for_numbers(Coordinate coordinate, double other, FloatNumbers numbers, const Visit& visit) {
  std::vector<SquarePoint> points;
  for (std::uint64_t k = numbers.first; k < kNumbers; k += numbers.stride) {
    points.push_back(point_of(coordinate, static_cast<double>(k) * 0x1p-24, other));
    if (points.size() < kBatch) continue;
    visit(points);
    points.clear();
  }
  if (!points.empty()) visit(points);
}

}  // namespace

Finding check_every_float(const SamplerOnMap& on_map, Coordinate coordinate, double other,
                          FloatNumbers numbers) {
  Finding found;
  const auto look = [&](const std::vector<SquarePoint>& points) {
    found = worse_of(std::move(found), check_drawn(on_map, points));
  };
  look({point_of(coordinate, 1.0 - 0x1p-53, other), point_of(coordinate, 1.0, other)});
  for_numbers(coordinate, other, numbers, look);
  return found;
}

Finding check_counts(const SamplerOnMap& on_map, Coordinate coordinate, double other,
                     FloatNumbers numbers) {
  const auto [width, height] = on_map.extent();
  const bool is_columns = coordinate == Coordinate::s;
  std::vector<double> counts(static_cast<std::size_t>(is_columns ? width : height), 0.0);
  int row = 0;
  for_numbers(coordinate, other, numbers, [&](const std::vector<SquarePoint>& points) {
    for (const TexelSample& sample : on_map.at(points)) {
      row = sample.y;
      const int cell = is_columns ? sample.x : sample.y;
      if (cell >= 0 && cell < static_cast<int>(counts.size())) {
        counts[static_cast<std::size_t>(cell)] += 1.0;
      }
    }
  });
  const double all = std::ceil(static_cast<double>(kNumbers - numbers.first) / numbers.stride);
  const MassRounding& r = on_map.rounding();
  // Of sums of at most twice the sampler's steps at either end, of a run of 32 texels, of an
  // average cell; and the reference's rounding.
  const double rounding =
      r.relative + 2.0 * r.of_sums + (is_columns ? 32.0 * r.of_run : 0.0) + r.of_average + 1e-12;
  Finding found{.bound = 2.0 + rounding * all};
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    const double mass = is_columns ? on_map.exact().masses(static_cast<int>(cell), row) /
                                         on_map.exact().rows[static_cast<std::size_t>(row)]
                                   : on_map.exact().rows[cell];
    const double off = std::abs(counts[cell] - mass * all);
    if (off <= found.amount) continue;
    found.amount = off;
    found.came_out = fmt::format("{} {} gets {} numbers for {:.1f}", is_columns ? "column" : "row",
                                 cell, counts[cell], mass * all);
    if (off > found.bound) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

}  // namespace lightproof
