#include "lightproof/prefilter/texel_stencil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

const GaussRule<3> kRule;

/// A texel or a part of one.
struct Cell {
  double s_low;
  double s_high;
  double t_low;
  double t_high;
};

double squared_sine_of_half(double angle) {
  const double sine = std::sin(0.5 * angle);
  return sine * sine;
}

/// The share of the square [-1,1]^2 of (u, v) where along u + across v < inside.
double share_below(double inside, double along, double across) {
  // For a line along a side only the other number counts.
  constexpr double kLeast = 1e-9;
  const double p = std::max(along, kLeast);
  const double q = std::max(across, kLeast);
  const auto ramp = [](double x) { return x > 0.0 ? 0.5 * x * x : 0.0; };
  const double area =
      ramp(inside + p + q) - ramp(inside + p - q) - ramp(inside - p + q) + ramp(inside - p - q);
  return std::clamp(area / (4.0 * p * q), 0.0, 1.0);
}

/// Integrates a kernel around one axis.
class CellIntegral {
 public:
  CellIntegral(const ZonalKernel& kernel, SquarePoint axis)
      : kernel_(kernel), axis_(axis), sine_(sin_theta(axis.t)) {}

  /// The largest distance of a point of the cell from its centre, in radians, from above.
  static double radius(const Cell& cell) {
    const double sine = std::max({sin_theta(cell.t_low), sin_theta(cell.t_high),
                                  sin_theta(0.5 * (cell.t_low + cell.t_high))});
    return 0.5 * std::hypot(kPi * (cell.t_high - cell.t_low),
                            2.0 * kPi * (cell.s_high - cell.s_low) * sine);
  }

  double operator()(const Cell& cell) const {
    const double s = 0.5 * (cell.s_low + cell.s_high);
    const double t = 0.5 * (cell.t_low + cell.t_high);
    const double reach = radius(cell);
    const double distance = angle(s, t);
    if (distance - reach > kernel_.support.value) return 0.0;
    const double smooth =
        std::max(kernel_.width.value, std::min(distance - reach, kernel_.support.value));
    if (kernel_.has_edge && distance + reach > kernel_.support.value) {
      if (2.0 * reach <= kStraight) return by_cut(cell, distance);
    } else {
      if (2.0 * reach <= kTiny * smooth) return by_centre(cell);
      if (2.0 * reach <= kSmall * smooth) return by_nodes(cell);
    }
    return (*this)({cell.s_low, s, cell.t_low, t}) + (*this)({s, cell.s_high, cell.t_low, t}) +
           (*this)({cell.s_low, s, t, cell.t_high}) + (*this)({s, cell.s_high, t, cell.t_high});
  }

 private:
  static constexpr double kSmall = 0.25;
  static constexpr double kTiny = 0.02;
  /// Radians over which an edge is taken for a straight line.
  static constexpr double kStraight = 0.02;

  double angle(double s, double t) const {
    return 2.0 * std::asin(std::sqrt(std::min(1.0, haversine(s, t, sin_theta(t)))));
  }

  double haversine(double s, double t, double sine) const {
    return squared_sine_of_half(kPi * (t - axis_.t)) +
           sine * sine_ * squared_sine_of_half(2.0 * kPi * (s - axis_.s));
  }

  double by_centre(const Cell& cell) const {
    const double s = 0.5 * (cell.s_low + cell.s_high);
    const double t = 0.5 * (cell.t_low + cell.t_high);
    return (cell.s_high - cell.s_low) * (cell.t_high - cell.t_low) * solid_angle_per_square(t) *
           kernel_.value(haversine(s, t, sin_theta(t)));
  }

  /// A small cell that the edge cuts: the part within the support, with the kernel's value in the
  /// middle of that part.
  double by_cut(const Cell& cell, double distance) const {
    const double s = 0.5 * (cell.s_low + cell.s_high);
    const double t = 0.5 * (cell.t_low + cell.t_high);
    const double along = 0.5 * std::abs(angle(s, cell.t_high) - angle(s, cell.t_low));
    const double across = 0.5 * std::abs(angle(cell.s_high, t) - angle(cell.s_low, t));
    const double inside = kernel_.support.value - distance;
    const double nearest = distance - along - across;
    const double farthest = std::min(distance + along + across, kernel_.support.value);
    const double middle = std::sin(0.25 * (nearest + farthest));
    return (cell.s_high - cell.s_low) * (cell.t_high - cell.t_low) * solid_angle_per_square(t) *
           share_below(inside, along, across) * kernel_.value(middle * middle);
  }

  double by_nodes(const Cell& cell) const {
    const double width = cell.s_high - cell.s_low;
    const double height = cell.t_high - cell.t_low;
    double sum = 0.0;
    for (const GaussNode& in_t : kRule.nodes()) {
      const double t = cell.t_low + in_t.at * height;
      const double sine = sin_theta(t);
      for (const GaussNode& in_s : kRule.nodes()) {
        const double s = cell.s_low + in_s.at * width;
        sum += in_t.weight * in_s.weight * solid_angle_per_square(t) *
               kernel_.value(haversine(s, t, sine));
      }
    }
    return sum * width * height;
  }

  const ZonalKernel& kernel_;
  SquarePoint axis_;
  double sine_;
};

/// Columns on either side of the axis that a row's part of the support reaches.
double reach_in_turns(double support, SquarePoint axis, double t_low, double t_high) {
  const double polar = kPi * std::min(axis.t, 1.0 - axis.t);
  if (support >= polar) return 0.5;
  // The meridians that touch the cap; any row between them.
  const double half = std::asin(std::min(1.0, std::sin(support) / std::sin(polar)));
  const bool hemisphere = support >= 0.5 * kPi;
  return hemisphere || t_low > t_high ? 0.5 : std::min(0.5, half / (2.0 * kPi));
}

/// The part of a texel that column and row of the centre of output texel x fall into.
struct Phase {
  int column;
  std::int64_t numerator;  ///< of the position inside the column, over 2 width_out
};

Phase phase_of(int x, int width_in, int width_out) {
  const std::int64_t position = (2 * std::int64_t{x} + 1) * width_in;
  const std::int64_t per_column = 2 * std::int64_t{width_out};
  return {static_cast<int>(position / per_column), position % per_column};
}

}  // namespace

TexelStencil::TexelStencil(const ZonalKernel& kernel, Extent extent, SquarePoint axis,
                           double whole) {
  const CellIntegral integral(kernel, axis);
  const double reach_t = kernel.support.value / kPi;
  const int first_row = std::max(0, static_cast<int>((axis.t - reach_t) * extent.height));
  const int last_row =
      std::min(extent.height - 1, static_cast<int>((axis.t + reach_t) * extent.height));
  double sum = 0.0;
  for (int y = first_row; y <= last_row; ++y) {
    throw_if_interrupted();  // of a large map the weights of one stencil take seconds
    const double t_low = static_cast<double>(y) / extent.height;
    const double t_high = (y + 1.0) / extent.height;
    const double reach_s = reach_in_turns(kernel.support.value, axis, t_low, t_high);
    Run run = {y, static_cast<int>(std::floor((axis.s - reach_s) * extent.width)), {}};
    const int columns =
        std::min(extent.width,
                 static_cast<int>(std::floor((axis.s + reach_s) * extent.width)) - run.first + 1);
    for (int i = 0; i < columns; ++i) {
      const double s_low = static_cast<double>(run.first + i) / extent.width;
      run.weights.push_back(integral({s_low, s_low + 1.0 / extent.width, t_low, t_high}));
    }
    sum = std::accumulate(run.weights.begin(), run.weights.end(), sum);
    runs_.push_back(std::move(run));
  }
  for (Run& run : runs_) {
    for (double& weight : run.weights) weight *= whole / sum;
  }
}

glm::dvec3 TexelStencil::sum(const Grid<Rgb>& map, int column) const {
  const int width = map.extent().width;
  glm::dvec3 sum(0.0);
  for (const Run& run : runs_) {
    const auto row = map.row(run.row);
    int x = ((run.first + column) % width + width) % width;
    for (const double weight : run.weights) {
      sum += weight * glm::dvec3(row[static_cast<std::size_t>(x)]);
      if (++x == width) x = 0;
    }
  }
  return sum;
}

Grid<glm::dvec3> local_sums(const Grid<Rgb>& map, const ZonalKernel& kernel, double whole,
                            Extent extent) {
  const int width = map.extent().width;
  // Columns whose centres lie at the same position of a texel share a stencil.
  const int phases = extent.width / std::gcd(width, extent.width);
  Grid<glm::dvec3> sums(extent);
  parallel_for(static_cast<std::size_t>(extent.height) * static_cast<std::size_t>(phases),
               [&](std::size_t task) {
                 const int y = static_cast<int>(task / static_cast<std::size_t>(phases));
                 const int first = static_cast<int>(task % static_cast<std::size_t>(phases));
                 const Phase phase = phase_of(first, width, extent.width);
                 const double position =
                     static_cast<double>(phase.numerator) / (2.0 * extent.width * width);
                 const TexelStencil stencil(kernel, map.extent(),
                                            {position, (y + 0.5) / extent.height}, whole);
                 for (int x = first; x < extent.width; x += phases) {
                   throw_if_interrupted();
                   sums(x, y) = stencil.sum(map, phase_of(x, width, extent.width).column);
                 }
               });
  return sums;
}

glm::dvec3 local_sum(const Grid<Rgb>& map, const ZonalKernel& kernel, double whole,
                     Direction axis) {
  return TexelStencil(kernel, map.extent(), square_from_direction(axis), whole).sum(map, 0);
}

}  // namespace lightproof
