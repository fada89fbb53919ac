// The product L k of the map and the material, tabulated for one point: the least variance that a
// table can reach, for the price of a table for every point.
#pragma once

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// The share of k's mean that every texel of a product table has besides its own k.
inline constexpr double kProductTableShare = 1e-3;

/// Texels in proportion to their luminance, their solid angle and the mean of k over their centre
/// and corners, plus a thousandth of k's mean, so that all light is reached. What is left of the
/// variance of an unoccluded point is that of k inside a texel. The table is made in double for
/// every shading point, which counts as time of the estimate. Throws InputError if the map is
/// black.
PreparedSource product_table_source(const EnvironmentMap& map);

}  // namespace lightproof
