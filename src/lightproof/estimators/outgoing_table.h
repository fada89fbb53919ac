// The radiance that a material reflects, tabulated over all normals and all views: four dimensions,
// one fetch, and the most memory of all.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// Samples by which each entry of an outgoing table is filled.
inline constexpr std::uint64_t kOutgoingTableSamples = 64;

/// The point whose reflected radiance an outgoing table has for this one: that of its entry.
ShadingPoint outgoing_table_point(const ShadingPoint& at);

/// 32 x 16 normals times 16 x 8 views; the nearest entry is what a point reflects, so that the step
/// of the table is its bias. Binding fills the table for the material, each entry by
/// kOutgoingTableSamples of lobes or map at Sobol's points, which belongs to the set-up. Nothing is
/// in the way of light.
PreparedEstimator outgoing_table(const EnvironmentMap& map);

}  // namespace lightproof
