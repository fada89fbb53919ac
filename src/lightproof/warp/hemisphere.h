// Warps from the unit square to the hemisphere around +z, each with its density.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// The unit vector with this cosine to +z and azimuth 2 pi u, u in [0,1].
inline Direction direction_around_z(double cosine, double u) {
  const double sine = std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine)));
  const double phi = 2.0 * kPi * u;
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// A direction of the uniform density 1/2pi over the hemisphere around +z, from a uniform point of
/// the square (Archimedes: equal heights, equal areas). u.t = 0 gives the pole.
inline Direction uniform_hemisphere_from_square(SquarePoint u) {
  return direction_around_z(1.0 - u.t, u.s);
}
/// The density 1/2pi of a direction above the horizon, 0 below.
inline PerSteradian uniform_hemisphere_pdf(Direction local) {
  return {local.z > 0.0 ? 1.0 / (2.0 * kPi) : 0.0};
}

/// A direction of the density cos(theta)/pi over the hemisphere around +z, from a uniform point of
/// the square by inversion. u.t = 0 gives the pole.
inline Direction cosine_hemisphere_from_square(SquarePoint u) {
  return direction_around_z(std::sqrt(1.0 - u.t), u.s);
}
/// The density cos(theta)/pi of a direction above the horizon, 0 below.
inline PerSteradian cosine_hemisphere_pdf(Direction local) {
  return {std::max(0.0, local.z) / kPi};
}

/// Whether cosine_power() goes by repeated squaring at this exponent: whole ones up to 1024.
inline bool squares_power(double n) {
  constexpr double kMostSquared = 1024.0;
  return n <= kMostSquared && n == std::floor(n);
}

/// cosine^n for a cosine and n in [0, inf). Whole exponents go by repeated squaring: a fraction of
/// std::pow's time, with an error of at most n ulp.
inline double cosine_power(double cosine, double n) {
  if (!squares_power(n)) return std::pow(cosine, n);
  double power = 1.0;
  double square = cosine;
  for (auto bits = static_cast<unsigned>(n); bits != 0; bits >>= 1U, square *= square) {
    if ((bits & 1U) != 0) power *= square;
  }
  return power;
}

/// A direction of Phong's lobe around +z, of the density (n+1)/2pi cos^n(theta) for an exponent
/// n >= 0, from a uniform point of the square by inversion. u.t = 0 gives the pole.
inline Direction phong_lobe_from_square(SquarePoint u, double exponent) {
  return direction_around_z(std::pow(1.0 - u.t, 1.0 / (exponent + 1.0)), u.s);
}
/// The density (n+1)/2pi cos^n of Phong's lobe at this cosine to its axis, 0 below the horizon.
inline PerSteradian phong_lobe_pdf(double cosine, double exponent) {
  if (cosine <= 0.0) return {0.0};
  return {(exponent + 1.0) / (2.0 * kPi) * cosine_power(cosine, exponent)};
}

}  // namespace lightproof
