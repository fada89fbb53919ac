#include "lightproof/stats/knee.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// Points that must lie on either side of a knee.
constexpr std::size_t kBeyond = 2;

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// What a straight line leaves of y.
struct Straightened {
  double slope = 0.0;
  std::vector<double> residuals;
};

Straightened straightened(std::span<const double> x, std::span<const double> y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  std::vector<double> from_mean;
  Straightened line;
  for (std::size_t i = 0; i < x.size(); ++i) {
    from_mean.push_back(x[i] - mean_x);
    line.residuals.push_back(y[i] - mean_y);
  }
  line.slope = product(from_mean, line.residuals) / product(from_mean, from_mean);
  for (std::size_t i = 0; i < x.size(); ++i) line.residuals[i] -= line.slope * from_mean[i];
  return line;
}

/// Whether the residuals are no more than what rounding leaves of values on a line.
bool is_rounding(std::span<const double> residuals, std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double step = largest * std::numeric_limits<double>::epsilon();
  // Sums of n terms, of the mean and of the slope.
  const auto count = static_cast<double>(values.size());
  return product(residuals, residuals) <= count * (count * step) * (count * step);
}

/// The points at which a line may bend, one for each x.
std::vector<std::size_t> places_of(std::span<const double> x) {
  std::vector<std::size_t> places;
  for (std::size_t i = kBeyond; i + kBeyond < x.size(); ++i) {
    const bool inside = x[i] > x[kBeyond - 1] && x[i] < x[x.size() - kBeyond];
    if (inside && x[i] > x[i - 1]) places.push_back(i);
  }
  return places;
}

/// The broken line with its knee at a point; the p-value for that place alone.
Knee bent_at(std::size_t point, std::span<const double> x, const Straightened& line) {
  std::vector<double> beyond;
  for (const double place : x) beyond.push_back(std::max(place - x[point], 0.0));
  const Straightened bend = straightened(x, beyond);
  const double weight = product(bend.residuals, bend.residuals);
  const double change = product(bend.residuals, line.residuals) / weight;
  const double before = line.slope - change * bend.slope;
  const double left = product(line.residuals, line.residuals) - change * change * weight;
  const auto dof = static_cast<double>(x.size() - 3);
  const double t = std::abs(change) / std::sqrt(std::max(left, 0.0) / dof / weight);
  return {point, before, before + change, 2.0 * student_upper(t, dof)};
}

}  // namespace

std::optional<Knee> find_knee(std::span<const LinePoint> points, double level) {
  std::vector<double> x;
  std::vector<double> y;
  for (const LinePoint& point : points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  const std::vector<std::size_t> places = places_of(x);
  if (places.empty()) return std::nullopt;
  const Straightened line = straightened(x, y);
  if (is_rounding(line.residuals, y)) return std::nullopt;
  Knee sharpest;
  for (const std::size_t place : places) {
    const Knee knee = bent_at(place, x, line);
    if (knee.p_value < sharpest.p_value) sharpest = knee;
  }
  sharpest.p_value = std::min(1.0, sharpest.p_value * static_cast<double>(places.size()));
  if (sharpest.p_value > level) return std::nullopt;
  return sharpest;
}

}  // namespace lightproof
