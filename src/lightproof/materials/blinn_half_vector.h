// Blinn's half-vector lobe as a microfacet distribution, with a shininess S = 2/R^4 - 2 for a
// roughness R (Blinn 1977; Walter et al. 2007, eq. 30). Directions are local, z along the surface's
// normal. The lecture's forms, for a view along the normal, stand in the namespace `published`.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// S = 2/R^4 - 2 >= 0, for a roughness in (0, 1]: 0 is a mirror, whose shininess is infinite.
inline double blinn_shininess(double roughness) {
  assert(roughness > 0.0 && roughness <= 1.0);
  const double square = roughness * roughness;
  return 2.0 / (square * square) - 2.0;
}

/// (n.h)^exponent of a unit vector h above the surface. From h.x^2 + h.y^2: an exponent of 1e8
/// would make 1e-8 of a rounding of h.z.
inline double cosine_to_power(Direction h, double exponent) {
  const double square = h.x * h.x + h.y * h.y;
  return square < 0.5 ? std::exp(0.5 * exponent * std::log1p(-square)) : std::pow(h.z, exponent);
}

/// D(h) = (S+2)/2pi (n.h)^S, per steradian; ∫ D(h) (n.h) dh = 1; 0 below the surface.
inline double blinn_normal_distribution(double shininess, Direction h) {
  if (!(h.z > 0.0)) return 0.0;
  return (shininess + 2.0) / (2.0 * kPi) * cosine_to_power(h, shininess);
}

/// The normal whose cosine has the logarithm `log_cosine` <= 0, at the azimuth 2 pi u.
inline Direction normal_at_log_cosine(double log_cosine, double u) {
  const double sine = std::sqrt(-std::expm1(2.0 * log_cosine));
  const double phi = 2.0 * kPi * u;
  return {sine * std::cos(phi), sine * std::sin(phi), std::exp(log_cosine)};
}

/// Density D(h) (n.h): the cosine is (1 - u.t)^(1/(S+2)), and u.t = 0 gives the surface's normal.
inline Direction blinn_normal_from_square(double shininess, SquarePoint u) {
  return normal_at_log_cosine(std::log1p(-u.t) / (shininess + 2.0), u.s);
}
inline PerSteradian blinn_normal_pdf(double shininess, Direction h) {
  return {blinn_normal_distribution(shininess, h) * std::max(0.0, h.z)};
}

/// Density (S+1)/2pi (n.h)^S: the lecture's exponent, one less than that of D(h) (n.h).
inline Direction blinn_lobe_from_square(double shininess, SquarePoint u) {
  return normal_at_log_cosine(std::log1p(-u.t) / (shininess + 1.0), u.s);
}
inline PerSteradian blinn_lobe_pdf(double shininess, Direction h) {
  if (!(h.z > 0.0)) return {0.0};
  return {(shininess + 1.0) / (2.0 * kPi) * cosine_to_power(h, shininess)};
}

/// D(h) / (4 times the density of the reflected direction), for h of blinn_lobe_from_square and
/// light and view mirrored around it: (S+2)/(S+1) (n.h). Its mean is 1, its variance
/// 1/((S+1)(S+3)). With blinn_normal_from_square it is 1 throughout.
inline double blinn_lobe_weight(double shininess, double cosine) {
  return (shininess + 2.0) / (shininess + 1.0) * cosine;
}

namespace published {

/// S = 2/R^4 - 2 of any number. The lecture passes 0.5, 1.5 ... 6.5 where (i + 1/2)/7 is meant:
/// from 1.5 on S is negative. 0 gives infinity.
inline double blinn_shininess(double roughness) {
  const double square = roughness * roughness;
  return 2.0 / (square * square) - 2.0;
}

/// r.s^(1/(S+1)) for the cosine and 2 pi r.t for the azimuth; not a number where S + 1 < 0, or = 0
/// and r.s = 0.
inline Direction blinn_normal_from_square(double shininess, SquarePoint r) {
  const double cosine = std::pow(r.s, 1.0 / (shininess + 1.0));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const double phi = 2.0 * kPi * r.t;
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// (S+1) cosine^S: the density of the cosine in [0,1], passed off as one over directions. It lacks
/// 1/2pi.
inline double blinn_normal_pdf(double shininess, double cosine) {
  return (shininess + 1.0) * std::pow(cosine, shininess);
}

/// D/PDF of the reflected direction, PDF = blinn_normal_pdf / (4 cosine): (2/pi) (S+2)/(S+1)
/// cosine, and so 2/pi times the corrected weight on average. It lacks 1/2pi in the density and the
/// 1/4 of the model.
inline double blinn_weight(double shininess, double cosine) {
  const double d = (shininess + 2.0) / (2.0 * kPi) * std::pow(cosine, shininess);
  return d / (blinn_normal_pdf(shininess, cosine) / (4.0 * cosine));
}

}  // namespace published

/// The roughness of level `level` of `levels`: (level + 1/2) / levels, in (0, 1).
inline double blinn_roughness_of_level(int level, int levels) { return (level + 0.5) / levels; }

/// The level at which a roughness stands, which may lie between two: levels R - 1/2.
inline double blinn_level_of_roughness(double roughness, int levels) {
  return levels * roughness - 0.5;
}

}  // namespace lightproof
