// Methods that may reach an error: estimators with a number of samples, and what each takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
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
  /// Whether methods whose number of samples is not predicted, or only bounded, may be candidates:
  /// they will be tried.
  bool will_be_tried = false;
};

/// An estimator at the number of samples at which it is predicted to reach the error.
struct Candidate {
  const EstimatorInfo* info;
  std::optional<PredictedError> error;  ///< none: it is not predicted
  MethodCost cost;
  /// 0 if no number of samples is predicted to reach the error.
  std::uint64_t samples = 0;

  /// Processor time of a shading point, with its part of the set-up.
  double seconds(const MethodDemand& demand, std::uint64_t of_samples) const {
    return cost.seconds_of(of_samples) +
           cost.set_up_seconds / static_cast<double>(demand.shading_points);
  }
};

/// What keeps a method from reaching an error.
struct Obstacle {
  double distance = std::numeric_limits<double>::infinity();  ///< how many times too much
  std::string reason;  ///< "environment B needs 5e+05 samples, of 65536 at most"
};

/// What keeps families from reaching an error: of each the method that misses it least.
class FamilyObstacles {
 public:
  void add(EstimatorFamily family, Obstacle obstacle);
  /// What stops every family but those that are reached, in their order.
  std::vector<UnreachedFamily> list(const std::vector<EstimatorFamily>& reached) const;

 private:
  std::map<EstimatorFamily, Obstacle> nearest_;
};

/// All methods: those that reach the error or may do so, why the others do not, and of what nothing
/// is predicted.
struct Candidates {
  std::vector<Candidate> possible;  ///< the cheapest first, by hoped_seconds()
  FamilyObstacles obstacles;
  std::vector<UnpredictedMethod> unpredicted;
};

/// The number of samples at which an error is reached, a multiple of those that make an estimate;
/// none if no number does.
std::optional<std::uint64_t> samples_for(const EstimatorInfo& info, const PredictedError& predicted,
                                         double error);

/// Whether it takes a run to know how many samples the candidate needs, and whether any number
/// does: where nothing is predicted, where it is an upper bound, and where something is in the way
/// of light.
bool is_uncertain(const Candidate& candidate, const MethodDemand& demand);

/// A number of samples that may turn out to do, no more than there is hope for: of an uncertain one
/// that will be tried by the slope of the best point sets and by what may be blocked; else what is
/// predicted.
std::uint64_t hoped_samples(const Candidate& candidate, const MethodDemand& demand);
/// Seconds that a shading point takes with hoped_samples().
double hoped_seconds(const Candidate& candidate, const MethodDemand& demand);

/// The largest number of samples with which the candidate keeps to budget and kMostDirections, in
/// whole estimates; 0 if there is none.
std::uint64_t most_samples(const Candidate& candidate, const MethodDemand& demand);

/// What keeps a candidate at a number of samples from being a choice; nothing if it can be one. 0
/// samples: no number of them is predicted to reach the error.
std::optional<Obstacle> obstacle_to(const MethodDemand& demand, const Candidate& candidate,
                                    std::uint64_t samples);

/// The least number of samples, not below `samples`, that is a whole number of the estimator's
/// independent estimates.
std::uint64_t in_steps(const EstimatorInfo& info, double samples);

/// What predictions and costs say of every estimator.
Candidates candidates_for(const MethodDemand& demand, const Prediction& prediction,
                          const MethodCosts& costs, Extent map);

}  // namespace lightproof
