// Straight lines on log-log paper.
#pragma once

#include <cmath>
#include <span>

namespace lightproof {

/// A relative variance (variance over squared mean) below which an estimator counts as exact: what
/// is left is the quadrature's own error.
inline constexpr double kNoVariance = 1e-8;

/// A measured point of a power law; both coordinates are positive.
struct PowerLawPoint {
  double x;
  double y;
  double relative_error;  ///< standard error of y over y
};

/// A fitted power law, y = constant * x^exponent.
struct PowerLaw {
  double exponent = 0.0;
  double exponent_error = 0.0;  ///< from the points' own errors
  double constant = 0.0;
};

/// The power law through points, by weighted least squares on the logarithms. Needs two points of
/// different x; all x, y > 0.
inline PowerLaw fit_power_law(std::span<const PowerLawPoint> points) {
  double sw = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  for (const PowerLawPoint& point : points) {
    const double w = 1.0 / (point.relative_error * point.relative_error);
    sw += w;
    sx += w * std::log(point.x);
    sy += w * std::log(point.y);
  }
  double sxx = 0.0;
  double sxy = 0.0;
  for (const PowerLawPoint& point : points) {
    const double w = 1.0 / (point.relative_error * point.relative_error);
    const double dx = std::log(point.x) - sx / sw;
    sxx += w * dx * dx;
    sxy += w * dx * std::log(point.y);
  }
  const double exponent = sxy / sxx;
  return {exponent, 1.0 / std::sqrt(sxx), std::exp((sy - exponent * sx) / sw)};
}

}  // namespace lightproof
