// The equal-area octahedral warp: the square folded over an octahedron, every equal area of the
// square the same solid angle. Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using
// SIMD"; the octahedral maps of pbrt-v4 use it. The upper hemisphere (z > 0) is the inner diamond,
// +x lies at (1, 1/2), +y at (1/2, 1), the nadir at all four corners.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// Unit vector of a point of [0,1]^2.
inline Direction octahedral_from_square(SquarePoint at) {
  const double u = 2.0 * at.s - 1.0;
  const double v = 2.0 * at.t - 1.0;
  const double to_diamond = 1.0 - (std::abs(u) + std::abs(v));
  const double radius = 1.0 - std::abs(to_diamond);
  const double turn = radius == 0.0 ? 1.0 : (std::abs(v) - std::abs(u)) / radius + 1.0;
  const double phi = 0.25 * kPi * turn;
  const double sine = radius * std::sqrt(2.0 - radius * radius);
  return {std::copysign(sine * std::cos(phi), u), std::copysign(sine * std::sin(phi), v),
          std::copysign(1.0 - radius * radius, to_diamond)};
}

/// The point of [0,1]^2 of a unit vector; (1, 1) for the nadir, which is all four corners.
inline SquarePoint square_from_octahedral(Direction d) {
  // sqrt(1 - |z|) without its cancellation near the poles.
  const double radius =
      std::min(1.0, std::hypot(d.x, d.y) / std::sqrt(1.0 + std::min(1.0, std::abs(d.z))));
  const double v = radius * std::atan2(std::abs(d.y), std::abs(d.x)) * (2.0 / kPi);
  const double u = radius - v;
  const bool lower = d.z < 0.0;
  return {0.5 + 0.5 * std::copysign(lower ? 1.0 - v : u, d.x),
          0.5 + 0.5 * std::copysign(lower ? 1.0 - u : v, d.y)};
}

/// Density over directions of octahedral_from_square() for uniform points: 1 / (4 pi), in sr^-1.
inline PerSteradian octahedral_pdf(Direction) { return {1.0 / kSphere}; }

}  // namespace lightproof
