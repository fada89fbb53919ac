// From where a one-sample estimator draws the directions of its samples.
#pragma once

#include <variant>

#include "lightproof/image/target_density.h"

namespace lightproof {

/// Directions uniform over the sphere, with the density 1/(4 pi) per steradian.
struct UniformSphere {};

/// Directions of the material's own lobes, with the density that the material declares per
/// steradian.
struct MaterialLobes {};

/// Directions of the environment map, in proportion to its luminance as DensitySpace says.
struct MapDensity {
  DensitySpace density_space;
};

/// From where directions are drawn.
using DirectionSource = std::variant<UniformSphere, MaterialLobes, MapDensity>;

}  // namespace lightproof
