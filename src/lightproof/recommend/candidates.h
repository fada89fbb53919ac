// Methods that may reach an error: estimators with a number of samples, and what each takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/accuracy/method_costs.h"
#include "lightproof/estimators/estimator.h"
#include "lightproof/recommend/prediction.h"
#include "lightproof/results/recommendation.h"

namespace lightproof {

/// The most directions that an estimate may draw.
inline constexpr std::uint64_t kMostDirections = 65536;

/// What is asked of a method, and what it may take.
struct MethodDemand {
  double error = 0.05;           ///< root mean square over the points, bias included, over the mean
  double budget_seconds = 1e-3;  ///< a shading point, set-up shared out
  std::optional<std::size_t> memory = {};                     ///< beside the map itself, in bytes
  std::uint64_t shading_points = std::uint64_t{1920} * 1080;  ///< over which a set-up is shared out
  bool is_occluded = false;  ///< whether something blocks light: what ignores that is no choice
  /// Whether methods of which only an upper bound is predicted are given the benefit of the doubt:
  /// they will be tried.
  bool will_be_tried = false;
};

/// An estimator at the number of samples at which it is predicted to reach the error.
struct Candidate {
  const EstimatorInfo* info;
  PredictedError error;
  MethodCost cost;
  std::uint64_t samples;  ///< 0 if no number of samples reaches the error

  /// Processor time of a shading point, with its part of the set-up.
  double seconds(const MethodDemand& demand, std::uint64_t of_samples) const {
    return cost.seconds_of(of_samples) +
           cost.set_up_seconds / static_cast<double>(demand.shading_points);
  }
};

/// All methods, those that are predicted to reach the error and, a family each, why the others are
/// not.
struct Candidates {
  std::vector<Candidate> reaching;  ///< the cheapest first
  std::vector<UnreachedFamily> unreached;
};

/// The number of samples at which an error is reached, a multiple of those that make an estimate;
/// none if no number does.
std::optional<std::uint64_t> samples_for(const EstimatorInfo& info, const PredictedError& predicted,
                                         double error);

/// Whether the number of samples that is predicted is not the one that is needed, but at most that,
/// or, where something is in the way, a guess.
bool is_uncertain(const PredictedError& error, const MethodDemand& demand);

/// The fewest samples with which the candidate may be expected to reach the error; those of the
/// prediction if that is certain.
std::uint64_t fewest_samples(const Candidate& candidate, const MethodDemand& demand);

/// What keeps a candidate at a number of samples from being a choice: "environment B needs 5e+05
/// samples"; empty if nothing does.
std::string obstacle_to(const MethodDemand& demand, const Candidate& candidate,
                        std::uint64_t samples);

/// So many samples, or the next whole number of the estimator's independent estimates.
std::uint64_t in_steps(const EstimatorInfo& info, double samples);

/// What predictions and costs say of every estimator.
Candidates candidates_for(const MethodDemand& demand, const Prediction& prediction,
                          const MethodCosts& costs, Extent map);

}  // namespace lightproof
