// Irradiance by Monte Carlo integration, the way in which irradiance maps are usually computed:
//
//   cosine  directions of density cos/pi, E = pi times the mean of L
//   uniform directions of density 1/2pi, E = 2pi times the mean of L cos
//
// Cosine sampling has no variance where L is constant, and is not always better: a light so small
// that the cosine c hardly varies over its solid angle D has second moments pi L^2 c D under cosine
// and 2pi L^2 c^2 D under uniform sampling, which is less beyond 60 degrees.
#pragma once

#include <cstdint>
#include <span>

#include "lightproof/core/measure.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/radiance_function.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

/// The mean over all points, at least one, of value(direction around +z).
template <class Warp, class Value>
glm::dvec3 mean_over_hemisphere(std::span<const SquarePoint> points, Warp warp,
                                const Value& value) {
  glm::dvec3 sum(0.0);
  for (const SquarePoint u : points) sum += value(warp(u));
  return sum / static_cast<double>(points.size());
}

/// The radiance that a white diffuse surface reflects, E/pi: the mean of L over cosine-distributed
/// directions.
template <RadianceFunction Function>
Radiance cosine_sampled_reflection(const Function& radiance, Direction normal,
                                   std::span<const SquarePoint> points) {
  const Frame frame = frame_around(normal);
  return {mean_over_hemisphere(points, cosine_hemisphere_from_square, [&](Direction local) {
    return glm::dvec3(radiance(frame.to_world(local)));
  })};
}

/// E = pi times the mean of L, (pi/N) sum of L.
template <RadianceFunction Function>
Irradiance cosine_sampled_irradiance(const Function& radiance, Direction normal,
                                     std::span<const SquarePoint> points) {
  return {kPi * cosine_sampled_reflection(radiance, normal, points).rgb};
}

/// E = 2pi times the mean of L cos, for the density is 1/2pi.
template <RadianceFunction Function>
Irradiance uniform_sampled_irradiance(const Function& radiance, Direction normal,
                                      std::span<const SquarePoint> points) {
  const Frame frame = frame_around(normal);
  const glm::dvec3 mean = mean_over_hemisphere(
      points, uniform_hemisphere_from_square,
      [&](Direction local) { return local.z * glm::dvec3(radiance(frame.to_world(local))); });
  return {2.0 * kPi * mean};
}

/// As published in a course's text, which takes 2pi for the density of uniform directions and
/// divides by it: too small by a factor of 4pi^2.
template <RadianceFunction Function>
Irradiance uniform_sampled_irradiance_published(const Function& radiance, Direction normal,
                                                std::span<const SquarePoint> points) {
  const double published_pdf = 2.0 * kPi;
  const double pdf = 1.0 / (2.0 * kPi);
  return {uniform_sampled_irradiance(radiance, normal, points).rgb * pdf / published_pdf};
}

/// A map of cosine-sampled irradiance: at every normal `samples` directions of its own, drawn by
/// `seed`. The same bits whatever the number of threads. Throws InputError if there are no samples,
/// or no normals.
IrradianceMap cosine_sampled_irradiance_map(const EnvironmentMap& source, Extent normals,
                                            int samples, std::uint64_t seed);

}  // namespace lightproof
