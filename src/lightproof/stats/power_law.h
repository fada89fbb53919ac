// Straight lines on log-log paper.
#pragma once

#include <algorithm>
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

/// How many times their own standard errors the points lie from a law that was fitted to them, root
/// mean square over their number less two: about 1 if they follow it. Needs three points.
inline double scatter_about(const PowerLaw& law, std::span<const PowerLawPoint> points) {
  double chi_square = 0.0;
  for (const PowerLawPoint& point : points) {
    const double fitted = law.constant * std::pow(point.x, law.exponent);
    const double residual = std::log(point.y / fitted) / point.relative_error;
    chi_square += residual * residual;
  }
  return std::sqrt(chi_square / static_cast<double>(points.size() - 2));
}

/// The standard error of a fitted exponent. What scatters about the law by more than its own errors
/// follows none: the exponent is only as certain as the scatter allows for. Needs three points.
inline double exponent_error_with_scatter(const PowerLaw& law,
                                          std::span<const PowerLawPoint> points) {
  return law.exponent_error * std::max(1.0, scatter_about(law, points));
}

}  // namespace lightproof
