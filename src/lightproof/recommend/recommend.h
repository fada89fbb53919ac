// The least that a scene needs: the cheapest method, number of samples and table that reach an
// error, as predicted and as measured.
#pragma once

#include <cstdint>
#include <optional>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/accuracy/method_costs.h"
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

/// The cheapest method that reaches the error at the points of the receiver, at least
/// kReceiverPoints of them.
/// Predicted from a summary of the map and the costs; if it is to be verified, the cheapest ones
/// are run, the numbers of samples corrected by what was measured, and the cheapest of those that
/// do reach the error is the choice. What is in the way of light is not predicted but measured.
/// Throws InputError, which tells what stops each family, if no method reaches the error.
Recommendation recommend(const EnvironmentMap& map, const RecommendOptions& options,
                         const MethodCosts& costs, const Progress& progress = {});

}  // namespace lightproof
