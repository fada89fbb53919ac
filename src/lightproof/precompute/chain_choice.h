// The smallest chain of levels that a given error allows.
#pragma once

#include <cstdint>

#include "lightproof/image/environment_map.h"
#include "lightproof/precompute/request.h"

namespace lightproof {

struct ChainChoice {
  Extent extent;
  int levels;
  /// The error of the worst level, when it is looked up bilinearly at directions drawn at random.
  double look_up_error;
  /// The error at the worst roughness half-way between two levels, interpolated linearly; 0 of one
  /// level.
  double roughness_error;
};

/// The smallest number of levels, and for it the smallest level 0, whose errors are both at most
/// `largest_error`: root mean square relative to the map's mean radiance, the largest of red, green
/// and blue. The mirror, level 0 of a specular chain, takes no part: no map smaller than the
/// environment holds it, and the picture behind it serves as well; neither do roughnesses between
/// it and level 1. Sizes are doubled from a height of 4 texels (or faces of 2) until the level 0
/// has that of the environment. Throws InputError, with the least error that can be had, if none
/// suffices. `product` is any but a BRDF map; an irradiance map has one level.
ChainChoice choose_chain(const EnvironmentMap& map, const PrecomputeRequest& request,
                         Product product, double largest_error, std::uint64_t seed);

}  // namespace lightproof
