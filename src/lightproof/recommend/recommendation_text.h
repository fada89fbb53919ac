// What is said of a recommendation: why, what was off, why there is none.
#pragma once

#include <string>

#include "lightproof/materials/material.h"
#include "lightproof/recommend/candidates.h"
#include "lightproof/recommend/map_summary.h"
#include "lightproof/results/recommendation.h"

namespace lightproof {

/// One sentence: how much of the sphere light and lobe fill, what follows from that, and how much
/// longer the runner-up takes.
std::string reason_of(const Recommendation& recommendation, const MapSummary& summary,
                      const Material& material);

/// What was off in the prediction, or left out of it; empty if nothing was.
std::string warning_of(const Recommendation& recommendation, const MethodDemand& demand);

/// A message for the user.
std::string refusal_of(const RefusedRecommendation& refused);

}  // namespace lightproof
