#include "lightproof/prefilter/irradiance_bracket.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "lightproof/core/measure.h"
#include "lightproof/image/lat_long_texels.h"

namespace lightproof {
namespace {

struct Interval {
  double low;
  double high;

  double middle() const { return 0.5 * (low + high); }
  double length() const { return high - low; }
  Interval operator-(double shift) const { return {low - shift, high - shift}; }
};

/// The values of the cosine over an interval of angles, in radians.
Interval cosines(Interval angles) {
  const auto holds = [&](double angle) {  // this angle, by whole turns
    return std::floor((angles.high - angle) / (2.0 * kPi)) >=
           std::ceil((angles.low - angle) / (2.0 * kPi));
  };
  const auto [low, high] = std::minmax({std::cos(angles.low), std::cos(angles.high)});
  return {holds(kPi) ? -1.0 : low, holds(0.0) ? 1.0 : high};
}

/// Polar angle from the zenith and longitude 2 pi s.
struct Cell {
  Interval polar;
  Interval longitude;

  double solid_angle() const {
    return longitude.length() * 2.0 * std::sin(polar.middle()) * std::sin(0.5 * polar.length());
  }
};

struct Bounds {
  double lower = 0.0;
  double upper = 0.0;

  Bounds& operator+=(Bounds other) {
    lower += other.lower;
    upper += other.upper;
    return *this;
  }
};

/// Bounds of ∫ (n·w)+ d(omega) over cells, for one normal n.
class CosineBounds {
 public:
  explicit CosineBounds(Direction normal)
      : sine_(std::hypot(normal.x, normal.y)),
        height_(normal.z),
        longitude_(kPi - std::atan2(normal.y, normal.x)) {}

  Bounds of(const Cell& cell, int divisions) const {
    const Interval cosine = range(cell);
    if (cosine.high <= 0.0) return {};
    const double whole = signed_integral(cell);
    if (cosine.low >= 0.0) return {whole, whole};
    if (divisions > 0) return of_quarters(cell, divisions - 1);
    const double area = cell.solid_angle();
    return {std::max(whole, 0.0), std::min(area * cosine.high, whole - area * cosine.low)};
  }

 private:
  Bounds of_quarters(const Cell& cell, int divisions) const {
    const auto [theta0, theta1] = cell.polar;
    const auto [phi0, phi1] = cell.longitude;
    const double theta = cell.polar.middle();
    const double phi = cell.longitude.middle();
    Bounds sum;
    for (const Interval polar : {Interval{theta0, theta}, Interval{theta, theta1}}) {
      sum += of({polar, {phi0, phi}}, divisions);
      sum += of({polar, {phi, phi1}}, divisions);
    }
    return sum;
  }

  /// n·w = a sin(theta) + n.z cos(theta), with a between two multiples of a cosine: two waves in
  /// theta, of which one is always above and one always below.
  Interval range(const Cell& cell) const {
    const Interval level = cosines(cell.longitude - longitude_);
    const auto wave = [&](double cosine) {
      const double a = sine_ * cosine;
      const double radius = std::hypot(a, height_);
      const Interval values = cosines(cell.polar - std::atan2(a, height_));
      return Interval{radius * values.low, radius * values.high};
    };
    return {wave(level.low).low, wave(level.high).high};
  }

  /// ∫ n·w d(omega) = n·V.
  double signed_integral(const Cell& cell) const {
    const double step = cell.polar.length();
    const double middle = cell.polar.middle();
    const double sine_squared = 0.5 * (step - std::sin(step) * std::cos(2.0 * middle));
    const double sine_cosine = 0.5 * std::sin(step) * std::sin(2.0 * middle);
    const double level = 2.0 * std::sin(0.5 * cell.longitude.length()) *
                         std::cos(cell.longitude.middle() - longitude_);
    return sine_ * level * sine_squared + height_ * cell.longitude.length() * sine_cosine;
  }

  double sine_;
  double height_;
  double longitude_;
};

}  // namespace

IrradianceBracket irradiance_bracket(const EnvironmentMap& map, Direction normal, int divisions) {
  assert(divisions >= 0);
  require_lat_long(map, "irradiance");
  const auto [width, height] = map.radiance.extent();
  const CosineBounds bounds(normal);
  IrradianceBracket bracket{{glm::dvec3(0.0)}, {glm::dvec3(0.0)}};
  glm::dvec3 all(0.0);
  for (int y = 0; y < height; ++y) {
    IrradianceBracket row{{glm::dvec3(0.0)}, {glm::dvec3(0.0)}};
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 radiance(map.radiance(x, y));
      const Cell cell{{kPi * (height - 1 - y) / height, kPi * (height - y) / height},
                      {2.0 * kPi * x / width, 2.0 * kPi * (x + 1) / width}};
      const auto [lower, upper] = bounds.of(cell, divisions);
      row.lower.rgb += lower * radiance;
      row.upper.rgb += upper * radiance;
      all += radiance;
    }
    bracket.lower.rgb += row.lower.rgb;
    bracket.upper.rgb += row.upper.rgb;
  }
  // Rounding. Angles are known to 2^-53 times some 2 pi, and so n·w, to which edges, sines and
  // products add as much again: 32 units of 2^-53 of a cell's area in (theta, phi), whose sum over
  // the map is 2 pi^2 times the mean of L. And every sum of so many terms, none of them negative,
  // is off by no more than their number of units, relative to it.
  constexpr double kUnit = 0.5 * std::numeric_limits<double>::epsilon();
  const double cells = static_cast<double>(width) * height;
  const glm::dvec3 of_terms = 32.0 * kUnit * 2.0 * kPi * kPi / cells * all;
  const glm::dvec3 of_sums = kUnit * (width + height + 4.0 * divisions) * bracket.upper.rgb;
  bracket.lower.rgb = glm::max(bracket.lower.rgb - of_terms - of_sums, 0.0);
  bracket.upper.rgb += of_terms + of_sums;
  return bracket;
}

}  // namespace lightproof
