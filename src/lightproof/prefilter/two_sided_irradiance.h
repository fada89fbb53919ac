// The irradiance of normals and of their opposites, comb by comb: how irradiance_map.h works.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/prefilter/folded_row.h"
#include "lightproof/prefilter/normal_comb.h"

namespace lightproof {

/// E of a normal of the upper hemisphere and of its opposite: radiance times steradian.
struct TwoSidedIrradiance {
  glm::dvec3 upper;
  glm::dvec3 lower;
};

/// Entry c * teeth + i is of the i-th normal of comb c. All combs have as many teeth. `lattice` is
/// that of the source.
std::vector<TwoSidedIrradiance> two_sided_irradiance(const EnvironmentMap& source,
                                                     const FoldedLattice& lattice,
                                                     std::span<const NormalComb> combs);

}  // namespace lightproof
