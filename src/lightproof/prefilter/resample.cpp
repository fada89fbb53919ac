#include "lightproof/prefilter/resample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

/// The cells that one cell of another division covers, and how much of it each one has.
struct Overlap {
  int first;
  std::vector<double> shares;  ///< of first, first + 1, …; their sum is 1
};

/// For each of `to` equal parts of [0,1] what it covers of `from` equal parts, measured by
/// height(position).
template <class Height>
std::vector<Overlap> overlaps(int from, int to, const Height& height) {
  std::vector<Overlap> all;
  for (int i = 0; i < to; ++i) {
    // The parts are rounded outwards.
    const auto first = static_cast<int>(std::int64_t{i} * from / to);
    const auto end = static_cast<int>((std::int64_t{i + 1} * from + to - 1) / to);
    Overlap overlap = {first, {}};
    const double low = static_cast<double>(i) / to;
    const double high = (i + 1.0) / to;
    for (int cell = first; cell < end; ++cell) {
      const double begin = std::max(low, static_cast<double>(cell) / from);
      const double stop = std::min(high, (cell + 1.0) / from);
      overlap.shares.push_back(std::max(0.0, height(begin, stop)) / height(low, high));
    }
    all.push_back(overlap);
  }
  return all;
}

/// A number proportional to the solid angle between two t, in which nothing cancels.
double band(double low, double high) {
  return sin_theta(0.5 * (low + high)) * std::sin(0.5 * kPi * (high - low));
}

/// The mean of the map over the columns and rows that one texel covers.
glm::dvec3 mean_over(const Grid<Rgb>& map, const Overlap& columns, const Overlap& rows) {
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < rows.shares.size(); ++j) {
    const auto row = map.row(rows.first + static_cast<int>(j));
    glm::dvec3 along(0.0);
    for (std::size_t i = 0; i < columns.shares.size(); ++i) {
      along += columns.shares[i] * glm::dvec3(row[static_cast<std::size_t>(columns.first) + i]);
    }
    sum += rows.shares[j] * along;
  }
  return sum;
}

}  // namespace

Grid<Rgb> resampled(const Grid<Rgb>& map, Extent extent) {
  if (map.extent() == extent) return map;
  const auto columns = overlaps(map.extent().width, extent.width,
                                [](double low, double high) { return high - low; });
  const auto rows = overlaps(map.extent().height, extent.height, band);
  auto result = Grid<Rgb>::without_values(extent);
  parallel_for(rows.size(), [&](std::size_t y) {
    for (std::size_t x = 0; x < columns.size(); ++x) {
      result(static_cast<int>(x), static_cast<int>(y)) = Rgb(mean_over(map, columns[x], rows[y]));
    }
  });
  return result;
}

}  // namespace lightproof
