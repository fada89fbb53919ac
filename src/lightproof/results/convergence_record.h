// The error of an estimator against the number of samples.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lightproof {

/// The error of an estimator at one number of samples.
struct ConvergencePoint {
  std::uint64_t samples = 0;
  double rmse = 0.0;        ///< root mean square error over pixels and replicates / mean value
  double rmse_error = 0.0;  ///< its standard error (from the exact fourth moment)
  double predicted = 0.0;   ///< from the exact variance
};

struct ConvergenceRecord {
  std::string map;
  std::string receiver;
  std::string material;
  std::string estimator;
  int pixels = 0;
  int replicates = 0;                    ///< per pixel and number of samples
  std::vector<ConvergencePoint> points;  ///< ascending numbers of samples
  /// Of log rmse against log samples, fitted to the points whose rmse_error is below a quarter of
  /// the prediction; -1/2 is expected. Not a number, like slope_error, where fewer than three
  /// points are (light found by rare hits), or where the estimator has no variance at all.
  double slope = 0.0;
  double slope_error = 0.0;
  double measured_variance = 0.0;  ///< per sample, averaged over pixels, relative to mean^2
  double predicted_variance = 0.0;
  double variance_ratio_error = 0.0;  ///< standard error of measured / predicted
};

}  // namespace lightproof
