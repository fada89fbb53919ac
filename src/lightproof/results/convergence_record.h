// The error of an estimator against the number of samples.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace lightproof {

/// The error of an estimator at one number of samples.
struct ConvergencePoint {
  std::uint64_t samples = 0;
  double rmse = 0.0;        ///< root mean square error over pixels and replicates / mean value
  double rmse_error = 0.0;  ///< standard error of rmse, from the exact fourth moment
  double predicted = 0.0;   ///< the rmse that follows from the exact variance

  static auto fields(auto& point) {
    return std::tie(point.samples, point.rmse, point.rmse_error, point.predicted);
  }
};

/// The error of one estimator on one map, receiver and material against the number of samples.
struct ConvergenceRecord {
  std::string map;
  std::string receiver;
  std::string material;
  std::string estimator;
  int pixels = 0;                        ///< pixels at which light is gathered
  int replicates = 0;                    ///< estimates per pixel and number of samples
  std::vector<ConvergencePoint> points;  ///< ascending numbers of samples
  /// The slope of log rmse against log samples, fitted to the points whose rmse_error is below a
  /// quarter of the prediction; -1/2 is expected. Not a number, like slope_error, where fewer than
  /// three points are (light found by rare hits), or where the estimator has no variance at all.
  double slope = 0.0;
  double slope_error = 0.0;           ///< standard error of `slope`
  double measured_variance = 0.0;     ///< per sample, averaged over pixels, relative to mean^2
  double predicted_variance = 0.0;    ///< the exact one, averaged and relative in the same way
  double variance_ratio_error = 0.0;  ///< standard error of measured / predicted

  static auto fields(auto& record) {
    return std::tie(record.map, record.receiver, record.material, record.estimator, record.pixels,
                    record.replicates, record.points, record.slope, record.slope_error,
                    record.measured_variance, record.predicted_variance,
                    record.variance_ratio_error);
  }
};

}  // namespace lightproof
