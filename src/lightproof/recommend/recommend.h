// The least that a scene needs: the cheapest method, number of samples and table that reach an
// error, as predicted and as measured.
#pragma once

#include <cstdint>
#include <optional>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/accuracy/method_costs.h"
#include "lightproof/core/error.h"
#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/recommend/candidates.h"
#include "lightproof/results/recommendation.h"

namespace lightproof {

/// What a recommendation is asked for.
struct RecommendOptions {
  const ReceiverInfo* receiver;
  NamedMaterial material;
  MethodDemand demand;
  bool verify = true;
  std::uint64_t seed = 1;  ///< of the verification
};

/// No method reaches the error. The message names the method of each family that misses it least,
/// and what stops it.
class NoMethodReaches : public InputError {
 public:
  explicit NoMethodReaches(RefusedRecommendation refused);
  const RefusedRecommendation& refused() const { return refused_; }

 private:
  RefusedRecommendation refused_;
};

/// The cheapest method that reaches the error at the points of the receiver, at least
/// kReceiverPoints of them.
/// Predicted from a summary of the map and the costs; if it is to be verified, those that may be
/// the cheapest are run, others if none of these reaches the error, numbers of samples found and
/// corrected by what was measured, and the choice is what takes the least measured time of those
/// that do reach the error. What is in the way of light is not predicted but measured.
/// Throws NoMethodReaches if none does, and InputError if the map's texels are not those of
/// latitude and longitude or no light reaches the receiver.
Recommendation recommend(const EnvironmentMap& map, const RecommendOptions& options,
                         const MethodCosts& costs, const Progress& progress = {});

}  // namespace lightproof
