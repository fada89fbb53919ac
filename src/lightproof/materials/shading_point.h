// Where light is gathered, and a direction drawn for it.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// A point of a surface; `view` is the unit direction towards the eye, above the surface.
struct ShadingPoint {
  glm::dvec3 position;
  Frame frame;
  Direction view;
};

/// What a material does with light from one direction.
struct Scattering {
  double reflected_cosine;  ///< f_r (n·l)+, per steradian
  PerSteradian pdf;         ///< with which the material's own lobes draw the direction
};

struct DirectionSample {
  Direction direction;
  Scattering scattering;  ///< of that direction
};

}  // namespace lightproof
