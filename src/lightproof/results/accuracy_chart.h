// Speed against accuracy: what every estimator takes and how far it is off, on one map, receiver
// and material.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/results/estimator_family.h"

namespace lightproof {

/// The error and the time of an estimate of one number of samples.
struct AccuracyPoint {
  std::uint64_t samples = 0;
  /// Processor time of one estimate at one shading point in seconds, without the set-up: the least
  /// of several rounds.
  double seconds = 0.0;
  /// Root mean square error of luminance over shading points and replicates, bias included, divided
  /// by the mean of the reference over the shading points.
  double rmse = 0.0;
  double rmse_error = 0.0;  ///< standard error of `rmse`, from the scatter between replicates
  /// The rmse that follows from exact moments; not a number if they are not known.
  double predicted = std::numeric_limits<double>::quiet_NaN();

  static auto fields(auto& point) {
    return std::tie(point.samples, point.seconds, point.rmse, point.rmse_error, point.predicted);
  }
};

/// One estimator: a falling line, or a single point if its budget is without meaning to it.
struct AccuracyLine {
  std::string estimator;  ///< name in the registry of estimators
  EstimatorFamily family = EstimatorFamily::uniform;
  bool is_biased = false;
  double set_up_seconds = 0.0;            ///< elapsed, once for a map and a material
  double set_up_processor_seconds = 0.0;  ///< the same as processor time of all threads
  std::size_t bytes = 0;                  ///< memory of what was set up, beside the map itself
  std::vector<AccuracyPoint> points;      ///< ascending numbers of samples; at least one
  /// Slope of log rmse against log samples with its standard error, scatter included; not a number
  /// where fewer than three points could be measured to a quarter of their error.
  double slope = std::numeric_limits<double>::quiet_NaN();
  double slope_error = std::numeric_limits<double>::quiet_NaN();
  /// Root mean square bias over the shading points at the largest number of samples, divided like
  /// `rmse`: the error that no number of samples takes away. 0 of an unbiased one, and of one whose
  /// bias vanishes with more samples.
  double floor = 0.0;

  static auto fields(auto& line) {
    return std::tie(line.estimator, line.family, line.is_biased, line.set_up_seconds,
                    line.set_up_processor_seconds, line.bytes, line.points, line.slope,
                    line.slope_error, line.floor);
  }
};

/// An estimator that a chart does not show, and why.
struct LeftOutEstimator {
  std::string estimator;
  std::string reason;

  static auto fields(auto& left_out) { return std::tie(left_out.estimator, left_out.reason); }
};

/// All estimators on one map, receiver and material.
struct AccuracyChart {
  std::string map;
  std::string receiver;
  std::string material;      ///< "lambert", "phong:50", "ggx:0.3"
  bool is_occluded = false;  ///< whether something blocks light: what ignores that is off
  int shading_points = 0;
  int replicates =
      0;  ///< the least number of estimates at each shading point and number of samples
  std::string quality;              ///< "draft", "default", "paper"
  double mean = 0.0;                ///< of the reference's luminance over the shading points
  std::vector<AccuracyLine> lines;  ///< in the registry's order
  std::vector<LeftOutEstimator> left_out;

  static auto fields(auto& chart) {
    return std::tie(chart.map, chart.receiver, chart.material, chart.is_occluded,
                    chart.shading_points, chart.replicates, chart.quality, chart.mean, chart.lines,
                    chart.left_out);
  }
};

}  // namespace lightproof
