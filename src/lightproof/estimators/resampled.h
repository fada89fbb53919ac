// Resampled importance sampling (Burke, Ghosh and Heidrich 2005, "Bidirectional Importance Sampling
// for Direct Illumination"; Talbot, Cline and Egbert 2005, "Importance Resampling for Global
// Illumination"): of several candidates one is chosen in proportion to the light that it would
// bring if nothing were in the way, and only for that one the scene is asked.
#pragma once

#include "lightproof/estimators/estimator.h"
#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// Unbiased for any number of candidates from 1 on, up to LightSamples::kCapacity. A sample of the
/// budget is a chosen one; every one has candidates of its own.
PreparedEstimator resampled(PreparedSource candidates, std::size_t candidate_count);

}  // namespace lightproof
