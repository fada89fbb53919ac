// Diffuse reflection by a Riemann sum over K x J directions of the hemisphere, K azimuths and J
// polar angles, as lectures on image-based lighting give it:
//
//   L_o = rho pi / (K J) sum over k, j of L(theta_j, phi_k) cos(theta_j) sin(theta_j).
//
// They leave open where in its step a node lies; both choices are here. The sum's error for a
// constant map is the same factor for every map: what it takes for the white hemisphere, x / sin(x)
// for nodes in the middle and x / tan(x) for those at the end, x = pi / 2J. The corrected form
// divides by it. For nodes in the middle that gives each ring of directions its exact
// cosine-weighted area.
#pragma once

#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/prefilter/irradiance.h"
#include "lightproof/prefilter/radiance_function.h"

namespace lightproof {

enum class RiemannNodes {
  midpoint,  ///< (j - 1/2) steps, j = 1 … J, and so of the azimuth
  endpoint,  ///< j steps
};

struct RiemannRule {
  int azimuths;  ///< K, at least 1
  int polar;     ///< J, at least 1; at least 2 for endpoints, of which the last one counts nothing
  RiemannNodes nodes;
};

/// Throws InputError if the rule has too few steps.
void check(RiemannRule rule);

/// What the sum takes for pi/pi = 1: x / sin(x) or x / tan(x).
double riemann_sum_of_white(RiemannRule rule);

/// The radiance that a white diffuse surface (rho = 1) reflects, by the sum as published. Throws
/// InputError if the rule has too few steps.
template <RadianceFunction Function>
Radiance riemann_reflection_published(const Function& radiance, Direction normal,
                                      RiemannRule rule) {
  check(rule);
  const Frame frame = frame_around(normal);
  const double offset = rule.nodes == RiemannNodes::midpoint ? 0.5 : 1.0;
  glm::dvec3 sum(0.0);
  for (int j = 0; j < rule.polar; ++j) {
    const double theta = 0.5 * kPi * (j + offset) / rule.polar;
    const double weight = std::cos(theta) * std::sin(theta);
    for (int k = 0; k < rule.azimuths; ++k) {
      const double phi = 2.0 * kPi * (k + offset) / rule.azimuths;
      const Direction local = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta)};
      sum += weight * glm::dvec3(radiance(frame.to_world(local)));
    }
  }
  return {kPi / rule.azimuths / rule.polar * sum};
}

/// The sum of riemann_reflection_published() over that of white light: exact for light that does
/// not depend on the direction.
template <RadianceFunction Function>
Radiance riemann_reflection(const Function& radiance, Direction normal, RiemannRule rule) {
  return {riemann_reflection_published(radiance, normal, rule).rgb / riemann_sum_of_white(rule)};
}

}  // namespace lightproof
