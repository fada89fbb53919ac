// What hard inputs do to estimators, point sets and file formats. Each is named after its case.
#pragma once

#include "lightproof/stability/stability_case.h"

namespace lightproof {

/// How many points of a window are looked at.
inline constexpr std::uint64_t kPointWindow = 65536;

/// What is wrong with the points of a set from an index on: coordinates outside of [0,1), or equal
/// points. The amount is the share of points that another one equals.
Finding check_points(const PointSetInfo& method, std::uint64_t first, std::uint64_t window);

namespace trials {

Finding black_map(const EstimatorInfo& method, const TrialOptions& options);
Finding exposure(const EstimatorInfo& method, const TrialOptions& options);
Finding odd_sizes(const EstimatorInfo& method, const TrialOptions& options);
Finding pure_colours(const EstimatorInfo& method, const TrialOptions& options);
Finding denormal_map(const EstimatorInfo& method, const TrialOptions& options);
Finding compensated(const EstimatorInfo& method, const TrialOptions& options);
Finding two_maps(const EstimatorInfo& method, const TrialOptions& options);

Finding late_frames(const PointSetInfo& method, const TrialOptions& options);
Finding all_indices(const PointSetInfo& method, const TrialOptions& options);

Finding nan_texel(const MapFormatInfo& method, const TrialOptions& options);
Finding infinite_texel(const MapFormatInfo& method, const TrialOptions& options);
Finding negative_texel(const MapFormatInfo& method, const TrialOptions& options);
Finding small_values(const MapFormatInfo& method, const TrialOptions& options);
Finding large_values(const MapFormatInfo& method, const TrialOptions& options);
Finding read_twice(const MapFormatInfo& method, const TrialOptions& options);

}  // namespace trials
}  // namespace lightproof
