// Glossy reflection by maps that were prefiltered beforehand, one look-up by the mirrored view.
// Nothing is in the way of light to these: they know normal and view alone.
#pragma once

#include <span>
#include <vector>

#include "lightproof/estimators/estimator.h"
#include "lightproof/prefilter/lobe.h"

namespace lightproof {

/// The split sum's chain: its finest level, and how many levels there are.
inline constexpr Extent kSplitSumFinest = {256, 128};
inline constexpr int kSplitSumLevels = 5;

/// The lobe that a map is prefiltered with for a modified Phong material: the receiver's cosine at
/// n = r raises the exponent by one.
PhongLobe prefilter_lobe(const ModifiedPhong& phong);
/// The size of that map: eight rows to the width of the lobe, a power of two, at most 128.
Extent prefilter_extent(const PhongLobe& lobe);

/// What the material reflects of a white sky at these cosines of the view to the normal.
std::vector<double> reflected_of_white_sky(const Ggx& ggx, std::span<const double> cosines);
/// The light that Phong's lobe of unit reflectance, with the material's exponent, reflects of a
/// white sky of radiance 1, at each of these cosines of the view.
std::vector<double> reflected_of_white_sky(const ModifiedPhong& phong,
                                           std::span<const double> cosines);

/// The split sum (Karis 2013, "Real Shading in Unreal Engine 4"): a chain of GGX levels at n = v =
/// r, 256 x 128 texels and five levels, looked up by roughness; times what the material reflects of
/// a white sky at this view, of 64 cosines. Exact for constant light. GGX alone; binding to other
/// materials throws InputError.
PreparedEstimator split_sum(const EnvironmentMap& map);

/// A map prefiltered by Phong's lobe of the material's exponent with the receiver's cosine at n = r
/// (Heidrich and Seidel 1999, "Realistic, Hardware-accelerated Shading and Lighting"), times what
/// the lobe reflects of a white sky at this view; and the irradiance of the normal. Exact for
/// constant light. Binding prefilters the map for the material's exponent, which belongs to the
/// set-up. Modified Phong alone; binding to other materials throws InputError.
PreparedEstimator prefiltered_phong(const EnvironmentMap& map);

/// Whether the material is the modified Phong model.
bool is_phong(const Material& material);

}  // namespace lightproof
