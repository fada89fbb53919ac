// The hemisphere's warps around any normal: a warp around +z, turned by a frame. Frames differ by a
// turn around the normal, so the directions are others and their distribution is the same.
#pragma once

#include "lightproof/warp/frames.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

/// A direction of density 1/2pi above the plane across the unit vector n, by core/direction.h's
/// frame.
inline Direction uniform_hemisphere_around(Direction n, SquarePoint u) {
  return frame_around(n).to_world(uniform_hemisphere_from_square(u));
}

/// A direction of density 1/2pi above the plane across the unit vector n, by the tangent frame
/// (z x n, n x (z x n), n).
inline Direction uniform_hemisphere_by_tangent_frame(Direction n, SquarePoint u) {
  return to_frame(tangent_frame(n)).to_world(uniform_hemisphere_from_square(u));
}

/// A direction of density 1/2pi above the plane across the unit vector n, by the quaternion that
/// rotates +z, or below the horizon -z, to n.
inline Direction uniform_hemisphere_by_quaternion(Direction n, SquarePoint u) {
  return to_frame(quaternion_frame(n)).to_world(uniform_hemisphere_from_square(u));
}

/// A direction d of density (n.d)/pi, n being a unit vector, by core/direction.h's frame.
inline Direction cosine_hemisphere_around(Direction n, SquarePoint u) {
  return frame_around(n).to_world(cosine_hemisphere_from_square(u));
}

/// A direction d of density (n.d)/pi, n being a unit vector, by the tangent frame.
inline Direction cosine_hemisphere_by_tangent_frame(Direction n, SquarePoint u) {
  return to_frame(tangent_frame(n)).to_world(cosine_hemisphere_from_square(u));
}

/// A direction d of density (n.d)/pi, n being a unit vector, by the quaternion.
inline Direction cosine_hemisphere_by_quaternion(Direction n, SquarePoint u) {
  return to_frame(quaternion_frame(n)).to_world(cosine_hemisphere_from_square(u));
}

/// As published: the quaternion always rotates +z, and the poles are treated apart. Directions near
/// -z are no unit vectors, and not around n.
inline Direction published_cosine_hemisphere_by_quaternion(Direction n, SquarePoint u) {
  return to_frame(published_quaternion_frame(n)).to_world(cosine_hemisphere_from_square(u));
}

}  // namespace lightproof
