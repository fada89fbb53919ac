// Filtered importance sampling (Křivánek and Colbert 2008, "Real-time Shading with Filtered
// Importance Sampling"): few directions of the material's lobes, each looked up in a smaller map
// whose texels are as large as what the sample stands for.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// At Hammersley's points, shifted at random for every estimate. A sample's level is half the
/// binary logarithm of 1/(N pdf) over the solid angle of the map's texel there, at least 0. Biased:
/// light is blurred beyond the lobe and over the horizon, by less the more samples there are; what
/// is left then is the bilinear look-up.
PreparedEstimator filtered_sampling(const EnvironmentMap& map);

}  // namespace lightproof
