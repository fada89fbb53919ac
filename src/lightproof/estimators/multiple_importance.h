// Multiple importance sampling (Veach and Guibas 1995, "Optimally Combining Sampling Techniques for
// Monte Carlo Rendering"): the material's lobes and the map together, half of the samples each.
#pragma once

#include "lightproof/estimators/estimator.h"
#include "lightproof/estimators/light_samples.h"
#include "reference/combined_moments.h"

namespace lightproof {

/// The multi-sample estimator: as many samples of the lobes as of the map, each weighted by the
/// heuristic. Of an odd number of samples the lobes have one more, for they reach all that the
/// material reflects, and a compensated map does not. A single estimate is that of a pair. Of a
/// black map all samples are of the lobes.
PreparedEstimator multi_sample(const EnvironmentMap& map, DensitySpace density_space,
                               reference::Heuristic heuristic, double compensation);

/// The one-sample estimator by the balance heuristic: every sample is of the lobes or of the map,
/// by the toss of a coin. As a source of directions it takes any points.
PreparedSource one_sample_mixture(const EnvironmentMap& map, DensitySpace density_space,
                                  double compensation);

}  // namespace lightproof
