// The radiance that a material reflects, tabulated over all normals and all views: four dimensions,
// one fetch, and the most memory of all.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// 32 x 16 normals times 16 x 8 views; the nearest entry is what a point reflects, so that the step
/// of the table is its bias. Binding fills the table for the material, each entry by 64 samples
/// of lobes or map at Sobol's points, which belongs to the set-up. Nothing is in the way of light.
PreparedEstimator outgoing_table(const EnvironmentMap& map);

}  // namespace lightproof
