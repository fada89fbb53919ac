// The cheapest method that reaches an error on a map, receiver and material.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// An estimator with a number of samples, what it is expected to do, and what it did.
struct RecommendedMethod {
  std::string estimator;      ///< name in the registry of estimators
  std::uint64_t samples = 0;  ///< of one shading point; 1 if has_samples is false
  bool has_samples = true;    ///< whether their number has a meaning: not for a look-up
  std::size_t bytes = 0;      ///< memory beside the map itself
  /// Size of the table that directions are drawn from; 0 x 0 if there is none.
  Extent table = {0, 0};
  /// Expected root mean square error over the receiver's pixels, bias included, over the mean.
  double predicted_error = 0.0;
  bool is_upper_bound = false;  ///< whether the prediction is no more than one
  /// The same as measured; not a number if it was not.
  double measured_error = std::numeric_limits<double>::quiet_NaN();
  double measured_error_error = std::numeric_limits<double>::quiet_NaN();  ///< its standard error
  double milliseconds = 0.0;         ///< of one shading point, without set-up
  double set_up_milliseconds = 0.0;  ///< once for the map
};

/// A family of methods none of which reaches the error, and what stops it.
struct UnreachedFamily {
  std::string family;
  std::string reason;  ///< "its floor is 3.1 %", "needs 1.2e6 samples"
};

/// The answer to: what is the least that this scene needs?
struct Recommendation {
  std::string map;
  std::string receiver;
  std::string material;
  double error = 0.0;                ///< that was asked for
  std::uint64_t shading_points = 0;  ///< over which set-ups are shared out
  RecommendedMethod choice;
  std::optional<RecommendedMethod> runner_up;
  std::string reason;  ///< one sentence
  /// What was off, if a measured error was not as predicted; empty if none was.
  std::string warning;
  std::vector<UnreachedFamily> unreached;
};

}  // namespace lightproof
