// From where a one-sample estimator draws the directions of its samples.
#pragma once

#include <variant>

#include "lightproof/image/target_density.h"

namespace lightproof {

/// Uniform over the sphere, with the density 1/(4 pi) per steradian.
struct UniformSphere {};

/// The material's own lobes, with the density that the material declares per steradian.
struct MaterialLobes {};

/// The environment map, in proportion to its luminance: see DensitySpace.
struct MapDensity {
  DensitySpace density_space;
};

using DirectionSource = std::variant<UniformSphere, MaterialLobes, MapDensity>;

}  // namespace lightproof
