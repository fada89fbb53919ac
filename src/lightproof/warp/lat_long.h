// The latitude-longitude warp of the lecture material: s = 1/2 - phi/2pi, t = 1 - theta/pi.
// Its Jacobian is core/measure.h's solid_angle_per_square.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// Unit vector of (s, t); t = 0 is -z, t = 1 is +z, s = 1/2 is the half-plane of +x.
inline Direction direction_from_square(SquarePoint at) {
  const double phi = kPi - 2.0 * kPi * at.s;
  const double sine = sin_theta(at.t);
  return {sine * std::cos(phi), sine * std::sin(phi), cos_theta(at.t)};
}

/// (s, t) in [0,1) x [0,1] of a unit vector; s = 0 at the poles' own seam, where it is undefined.
inline SquarePoint square_from_direction(Direction d) {
  const double s = 0.5 - std::atan2(d.y, d.x) / (2.0 * kPi);
  // atan2 of both components keeps full precision near the poles, where acos(z) loses half of it.
  const double t = std::atan2(std::hypot(d.x, d.y), -d.z) / kPi;
  return {s >= 1.0 ? 0.0 : s, t};
}

}  // namespace lightproof
