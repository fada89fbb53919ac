// Measures are types: a density over the unit square and a density over directions cannot be
// mixed up, and the Jacobian between them is written in exactly one place.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightproof {

inline constexpr double kPi = std::numbers::pi;
/// Area of the unit sphere in steradian.
inline constexpr double kSphere = 4.0 * kPi;

/// An angle in radians. Degrees exist only on the command line.
struct Radians {
  double value;
};

/// A point (s, t) of the unit square [0,1)^2: a texture coordinate of the map, or a pair of
/// random numbers. t = 0 is the nadir, t = 1 the zenith.
struct SquarePoint {
  double s;
  double t;
  friend bool operator==(SquarePoint, SquarePoint) = default;
};

/// Density over (s, t) in [0,1)^2.
struct PerSquare {
  double value;
};

/// Density over directions, per steradian.
struct PerSteradian {
  double value;
};

/// sin(theta) = sin(pi t), from the nearer pole: exactly 0 at t = 0 and t = 1.
inline double sin_theta(double t) { return std::sin(kPi * std::min(t, 1.0 - t)); }

/// cos(theta) = -cos(pi t): -1 at the nadir (t = 0), 1 at the zenith (t = 1).
inline double cos_theta(double t) { return -std::cos(kPi * t); }

/// d(omega) / (ds dt) = 2 pi^2 sin(pi t), in steradian per unit square. Zero at the poles.
inline double solid_angle_per_square(double t) { return 2.0 * kPi * kPi * sin_theta(t); }

/// Converts a density over the square at `at` to one over directions. Infinite at a pole, where
/// the density over the square of any bounded density over directions is zero.
inline PerSteradian to_solid_angle(PerSquare p, SquarePoint at) {
  return {p.value / solid_angle_per_square(at.t)};
}

/// Converts a density over directions to one over the square at `at`, the inverse of
/// to_solid_angle. Zero at a pole.
inline PerSquare to_square(PerSteradian p, SquarePoint at) {
  return {p.value * solid_angle_per_square(at.t)};
}

}  // namespace lightproof
