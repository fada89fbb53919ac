// How the costs of a sampler grow with the map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// What one step of a search takes on maps of one size.
struct StepTime {
  Extent extent;
  double ns = 0.0;
};

/// The exponent of a power law, fitted by least squares on logarithms.
struct FittedExponent {
  double value = 0.0;
  double error = 0.0;  ///< standard error, from the scatter about the power law
};

/// Where the time of a step starts to grow in another way.
struct GrowthBreakpoint {
  Extent extent;
  double exponent_after = 0.0;  ///< exponent of ns per step against S + T from there on
};

/// Power laws that follow each other, of the time of a step, where a single one will not do.
struct SegmentedGrowth {
  double exponent_before = 0.0;               ///< exponent up to the first breakpoint
  std::vector<GrowthBreakpoint> breakpoints;  ///< one or two, ascending sizes
  double p_value = 1.0;  ///< P(scatter about one power law seems to have so clear a breakpoint)
};

/// How a sampler's costs grow with the map.
struct GrowthFit {
  std::string sampler;
  std::string model;      ///< how many steps one sample takes: "S + T" or "log2 S + log2 T"
  double exponent = 0.0;  ///< exponent of ns per sample against S + T, by least squares on logs
  double exponent_error = 0.0;  ///< standard error of `exponent`
  std::vector<StepTime> steps;  ///< ascending sizes; constant if time grows as the model does
  /// The smallest measured map whose table is larger than the L2 cache; none if all fit, or if the
  /// size of the cache is not known.
  std::optional<Extent> leaves_l2 = {};
  /// The smallest measured map whose table is larger than the L3 cache; none if all fit, or if the
  /// size of the cache is not known.
  std::optional<Extent> leaves_l3 = {};
  std::optional<SegmentedGrowth> segmented = {};      ///< none if one power law will do
  std::optional<FittedExponent> build_exponent = {};  ///< exponent of the time to build against S T
};

}  // namespace lightproof
