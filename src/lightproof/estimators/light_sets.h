// Lights that were drawn beforehand, a set for each of many orientations of the surface:
// precomputed importance sampling of environment maps.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// For each of 8 x 8 orientations 1024 directions at Sobol's points, in proportion to the map's
/// light times a cosine that is positive for every normal that is looked up there. An estimate
/// takes as many as its budget has from the set of its normal, from a random one on; beyond 1024 it
/// has seen them all, and its error stays what the set's own error is. Throws InputError if the map
/// is black.
PreparedEstimator light_sets(const EnvironmentMap& map);

}  // namespace lightproof
