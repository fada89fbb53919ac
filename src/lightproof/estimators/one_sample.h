// Estimators that draw each direction from one density and weigh it by one over that (Kajiya 1986;
// for a map, the lecture's 2 pi^2 sin(theta) / p(s,t)).
#pragma once

#include "lightproof/estimators/estimator.h"
#include "lightproof/render/direction_source.h"

namespace lightproof {

/// Prepares the estimator that draws directions from this source. Of a map it keeps the table of
/// one sampler, the fastest monotone one, so that stratified points stay stratified.
PreparedEstimator prepare_one_sample(const EnvironmentMap& map, DirectionSource source);

}  // namespace lightproof
