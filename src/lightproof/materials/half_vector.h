// The microfacet normal halfway between two directions, and the Jacobian of reflecting at it.
// Directions are local, z along the surface's normal.
#pragma once

#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// The normal that mirrors view and light into each other.
struct HalfVector {
  Direction normal;  ///< on the side of both directions; below the surface if the light is below it
                     ///< by more than the view is above it
  double cosine;     ///< to the view and to the light, in (0, 1]
};

/// The half vector of opposite directions. Every normal across the view is halfway between them:
/// the steepest one stands for all, and what a rounding leaves for the cosine, which is 0.
inline HalfVector half_vector_of_opposite(Direction view) {
  const double along = std::hypot(view.x, view.y);
  const Direction normal =
      along > 0.0 ? Direction(-view.x * view.z / along, -view.y * view.z / along, along)
                  : Direction(1.0, 0.0, 0.0);
  return {normal, 0x1p-54};
}

/// The cosine from the length of their sum, which loses nothing where they are nearly opposite.
inline HalfVector half_vector(Direction view, Direction light) {
  const Direction sum = view + light;
  const double length = glm::length(sum);
  if (!(length > 0.0)) return half_vector_of_opposite(view);
  return {sum / length, 0.5 * length};
}

/// A density over normals as one over the directions that they reflect the view to: divided by
/// 4 |v.h| (Torrance & Sparrow 1967; Walter et al. 2007, eq. 14).
inline PerSteradian reflected_density(PerSteradian of_normal, double cosine) {
  return {of_normal.value / (4.0 * std::abs(cosine))};
}

}  // namespace lightproof
