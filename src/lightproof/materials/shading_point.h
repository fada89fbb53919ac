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

struct DirectionSample {
  Direction direction;
  PerSteradian pdf;
};

}  // namespace lightproof
