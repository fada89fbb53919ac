#include "lightproof/gate/direction_histogram.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

namespace lightproof {
namespace {

static_assert(kGateBins == Extent{32, 16}, "edges at multiples of pi/16 in phi and theta");

/// Cells are found for so many directions at once, and then counted.
constexpr std::size_t kChunk = 1024;

/// tan^2 of pi/16, 2pi/16 and 3pi/16.
constexpr std::array kSquaredTangents = {0.03956612989658003475, 0.17157287525380990240,
                                         0.44646269217168956857};

/// The edges pi/16 … 7pi/16 that the angle atan(sqrt(rise2 / run2)) of [0, pi/2] has passed.
/// Beyond pi/4 they are counted from the other side.
inline double edges_passed(double run2, double rise2) {
  const double lesser = std::min(run2, rise2);
  const double greater = std::max(run2, rise2);
  double passed = 0.0;
  for (const double edge : kSquaredTangents) passed += lesser >= edge * greater ? 1.0 : 0.0;
  return rise2 >= run2 ? 7.0 - passed : passed;
}

/// Index of the bin, row by row, or `invalid`; a whole number, as a double because a vector of
/// doubles has no fast conversion to indices before the end. s goes from -x over +y, +x and -y.
inline double cell_at(double x, double y, double z, double invalid) {
  const double x2 = x * x;
  const double y2 = y * y;
  const double z2 = z * z;
  const double from_x_axis = edges_passed(x2, y2);
  const double half_turn = x < 0.0 ? from_x_axis : 15.0 - from_x_axis;
  const double column = y < 0.0 ? 31.0 - half_turn : half_turn;
  const double from_horizon = edges_passed(x2 + y2, z2);
  const double row = z < 0.0 ? 7.0 - from_horizon : 8.0 + from_horizon;
  const bool is_direction = std::abs(x2 + y2 + z2 - 1.0) < 0.5;  // false for NaN
  return is_direction ? row * kGateBins.width + column : invalid;
}

}  // namespace

void DirectionHistogram::add(const DirectionArrays& directions) {
  const auto [x, y, z] = directions;
  assert(x.size() == y.size() && x.size() == z.size());
  std::array<std::int32_t, kChunk> cells;
  for (std::size_t start = 0; start < x.size(); start += kChunk) {
    const std::size_t size = std::min(kChunk, x.size() - start);
    for (std::size_t i = 0; i < size; ++i) {
      cells[i] =
          static_cast<std::int32_t>(cell_at(x[start + i], y[start + i], z[start + i], kInvalid));
    }
    for (std::size_t i = 0; i < size; ++i) ++counts_[static_cast<std::size_t>(cells[i])];
  }
}

void DirectionHistogram::merge(const DirectionHistogram& other) {
  std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus<>());
}

Grid<std::uint64_t> DirectionHistogram::bins() const {
  Grid<std::uint64_t> bins(kGateBins);
  std::copy_n(counts_.begin(), kInvalid, bins.values().begin());
  return bins;
}

std::uint64_t DirectionHistogram::samples() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

}  // namespace lightproof
