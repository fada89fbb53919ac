// The latitude-longitude warp of the lecture material: s = 1/2 - phi/2pi, t = 1 - theta/pi.
// Its Jacobian is core/measure.h's solid_angle_per_square.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// The direction, a unit vector, of a point of the square: t = 0 is -z, t = 1 is +z, s = 1/2 is the
/// half-plane of +x.
inline Direction direction_from_square(SquarePoint at) {
  const double phi = kPi - 2.0 * kPi * at.s;
  const double from_pole = kPi * std::min(at.t, 1.0 - at.t);
  const double sine = std::sin(from_pole);
  const double height = std::cos(from_pole);
  return {sine * std::cos(phi), sine * std::sin(phi), at.t < 0.5 ? -height : height};
}

/// The point (s, t) in [0,1) x [0,1] of a unit vector; s = 0 at the poles, where it is undefined.
inline SquarePoint square_from_direction(Direction d) {
  const double s = 0.5 - std::atan2(d.y, d.x) / (2.0 * kPi);
  // atan2 of both components keeps full precision near the poles, where acos(z) loses half of it.
  const double t = std::atan2(std::hypot(d.x, d.y), -d.z) / kPi;
  return {s >= 1.0 ? 0.0 : s, t};
}

/// atan(r) for r in [0,1] with an error below 2e-8 rad (Abramowitz & Stegun 4.4.49).
inline double approximate_atan(double r) {
  const double q = r * r;
  double p = 0.0028662257;
  for (const double c : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528}) {
    p = p * q + c;
  }
  return r * (p * q + 1.0);
}

/// atan2(y, x) with an error below 4e-8 rad; 0 at the origin.
inline double approximate_atan2(double y, double x) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  const double larger = std::max(ax, ay);
  const double octant = larger > 0.0 ? approximate_atan(std::min(ax, ay) / larger) : 0.0;
  const double quadrant = ay > ax ? 0.5 * kPi - octant : octant;
  return std::copysign(x < 0.0 ? kPi - quadrant : quadrant, y);
}

/// The point (s, t) of a unit vector with an error below 2e-8 in s and t: enough to find a texel,
/// in a quarter of the time of square_from_direction().
inline SquarePoint approximate_square_from_direction(Direction d) {
  const double s = 0.5 - approximate_atan2(d.y, d.x) / (2.0 * kPi);
  const double t = approximate_atan2(std::sqrt(d.x * d.x + d.y * d.y), -d.z) / kPi;
  return {s >= 1.0 ? 0.0 : s, t};
}

/// Solid angle in steradian of every texel of row `y`: (2 pi / W)(cos of one edge - the other),
/// written as a product so that nothing cancels at the poles.
inline double texel_solid_angle(Extent extent, int y) {
  return 4.0 * kPi / extent.width * sin_theta((y + 0.5) / extent.height) *
         std::sin(0.5 * kPi / extent.height);
}

}  // namespace lightproof
