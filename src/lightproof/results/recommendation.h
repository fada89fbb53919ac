// The cheapest method that reaches an error on a map, receiver and material.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/results/estimator_family.h"

namespace lightproof {

/// Processor time in milliseconds.
struct MethodTime {
  double point = std::numeric_limits<double>::quiet_NaN();  ///< of one shading point, no set-up
  /// Set-up of all threads, once for the map and the material.
  double set_up = std::numeric_limits<double>::quiet_NaN();

  /// Time of one shading point, with its part of a set-up that so many share.
  double with_set_up(std::uint64_t shading_points) const {
    return point + set_up / static_cast<double>(shading_points);
  }

  static auto fields(auto& time) { return std::tie(time.point, time.set_up); }
};

/// An estimator with a number of samples, what it is expected to do, and what it did.
struct RecommendedMethod {
  std::string estimator;      ///< name in the registry of estimators
  std::uint64_t samples = 0;  ///< of one shading point; 1 if has_samples is false
  bool has_samples = true;    ///< whether their number has a meaning: not for a look-up
  std::size_t bytes = 0;      ///< memory beside the map itself
  /// Size of the table of the map that directions are drawn from; 0 x 0 if there is none.
  Extent table = {0, 0};
  /// Expected root mean square error over the receiver's pixels, bias included, over the mean, if
  /// nothing is in the way of light; not a number if there is no prediction.
  double predicted_error = std::numeric_limits<double>::quiet_NaN();
  bool is_upper_bound = false;  ///< whether the prediction is no more than one
  /// The measured error, whatever is in the way; not a number if it was not measured.
  double measured_error = std::numeric_limits<double>::quiet_NaN();
  double measured_error_error = std::numeric_limits<double>::quiet_NaN();  ///< its standard error
  MethodTime predicted_time = {};  ///< from costs on other maps
  MethodTime measured_time = {};   ///< on this map; not numbers if it was not run

  /// The measured time if there is one, else the predicted one.
  const MethodTime& known_time() const {
    return measured_time.point > 0.0 ? measured_time : predicted_time;
  }

  static auto fields(auto& method) {
    return std::tie(method.estimator, method.samples, method.has_samples, method.bytes,
                    method.table.width, method.table.height, method.predicted_error,
                    method.is_upper_bound, method.measured_error, method.measured_error_error,
                    method.predicted_time, method.measured_time);
  }
};

/// A family of methods none of which reaches the error, and what stops it.
struct UnreachedFamily {
  EstimatorFamily family = EstimatorFamily::uniform;
  std::string reason;  ///< "the floor of sh-9 is 3.1 %, above 2 %"

  static auto fields(auto& family) { return std::tie(family.family, family.reason); }
};

/// A method of which nothing is predicted, and why.
struct UnpredictedMethod {
  std::string estimator;
  std::string reason;

  static auto fields(auto& method) { return std::tie(method.estimator, method.reason); }
};

/// What was asked.
struct RecommendationQuestion {
  std::string map;
  std::string receiver;
  std::string material;
  double error = 0.0;
  std::uint64_t shading_points = 0;  ///< over which set-ups are shared out

  static auto fields(auto& question) {
    return std::tie(question.map, question.receiver, question.material, question.error,
                    question.shading_points);
  }
};

/// The answer to: what is the least that this scene needs?
struct Recommendation {
  RecommendationQuestion question;
  RecommendedMethod choice;
  std::optional<RecommendedMethod> runner_up;
  std::string reason;  ///< one sentence
  /// What was off, if a measured error was not as predicted, or what was left out of a prediction;
  /// empty if nothing was.
  std::string warning;
  std::vector<UnreachedFamily> unreached;
  /// What was neither predicted nor tried.
  std::vector<UnpredictedMethod> unpredicted;

  static auto fields(auto& answer) {
    return std::tie(answer.question, answer.choice, answer.runner_up, answer.reason, answer.warning,
                    answer.unreached, answer.unpredicted);
  }
};

/// The answer that no method reaches the error.
struct RefusedRecommendation {
  RecommendationQuestion question;
  std::vector<UnreachedFamily> unreached;

  static auto fields(auto& refused) { return std::tie(refused.question, refused.unreached); }
};

}  // namespace lightproof
