// How far precomputed maps are off, measured against quadrature that shares no code with them.
#pragma once

#include <cstddef>
#include <string>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/precompute/request.h"
#include "lightproof/results/precomputed_map.h"

namespace lightproof {

/// What check_level() estimates, as a sentence.
std::string error_measure();

/// Root mean square, over the sphere, of the difference between a level's texels and the exact
/// values at their centres (of a mirror, the exact means over the texels), relative to the mean
/// radiance of the map: the largest of red, green and blue, of those that have light; 0 of a map
/// without light. It is estimated from so many texels, each drawn in proportion to its solid angle,
/// with limits between which it lies with 95 % probability, by the central limit theorem.
LevelError check_level(const EnvironmentMap& map, Projection projection, const LevelPlan& plan,
                       const MapLevel& level, const RandomStream& stream, std::size_t texels);

/// Root mean square of the differences of scale and bias, absolute, from so many texels, drawn
/// evenly: against a sum over half-vectors of another rule.
LevelError check_brdf_map(const BrdfMap& map, Masking masking, const RandomStream& stream,
                          std::size_t texels);

}  // namespace lightproof
