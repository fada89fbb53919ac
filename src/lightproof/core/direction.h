// Directions and orthonormal frames. World axes: z up, right-handed.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace lightproof {

/// A unit vector.
using Direction = glm::dvec3;

/// Linear RGB; radiance in W sr^-1 m^-2 up to the map's own scale.
using Rgb = glm::vec3;

/// Unit vectors as three arrays of equal length. In double, since rounding to float moves a
/// direction by up to 6e-8 and so across an edge; a float converts to double exactly.
struct DirectionArrays {
  std::span<const double> x;
  std::span<const double> y;
  std::span<const double> z;
};

/// An orthonormal, right-handed frame (tangent, bitangent, normal).
struct Frame {
  Direction tangent;
  Direction bitangent;
  Direction normal;

  /// The world direction of one in local coordinates, whose z runs along the normal.
  Direction to_world(Direction local) const {
    return local.x * tangent + local.y * bitangent + local.z * normal;
  }
  /// The inverse of to_world.
  Direction to_local(Direction world) const {
    return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
  }
};

/// A frame around a unit normal; orthonormal to rounding for every normal, with a jump across
/// n.z = 0. Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
inline Frame frame_around(Direction n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// Mirrors `v` at the plane with normal `n`; both point away from the surface.
inline Direction reflect_about(Direction v, Direction n) { return 2.0 * glm::dot(v, n) * n - v; }

}  // namespace lightproof
