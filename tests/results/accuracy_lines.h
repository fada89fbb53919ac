// Small lines of charts of speed against accuracy, for tests.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/results/accuracy_chart.h"

namespace lightproof::testing {

/// Error 1 / sqrt(N), a microsecond a sample, at N = 1, 4, 16, 64.
inline AccuracyLine falling(const char* name, EstimatorFamily family, double scale = 1.0) {
  AccuracyLine line;
  line.estimator = name;
  line.family = family;
  for (const std::uint64_t samples : {1, 4, 16, 64}) {
    const auto n = static_cast<double>(samples);
    const double error = scale / std::sqrt(n);
    line.points.push_back({samples, 1e-6 * n, error, 0.02 * error});
  }
  return line;
}

inline AccuracyLine look_up(const char* name, double seconds, double error) {
  AccuracyLine line;
  line.estimator = name;
  line.family = EstimatorFamily::precomputed;
  line.is_biased = true;
  line.floor = error;
  line.points = {{1, seconds, error, 0.0}};
  return line;
}

inline AccuracyChart chart_of(std::vector<AccuracyLine> lines) {
  AccuracyChart chart;
  chart.map = "map";
  chart.receiver = "sphere";
  chart.material = "lambert";
  chart.shading_points = 24;
  chart.quality = "draft";
  chart.lines = std::move(lines);
  return chart;
}

}  // namespace lightproof::testing
