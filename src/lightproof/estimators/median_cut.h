// A map as a few lights of equal power (Debevec 2005, "A Median Cut Algorithm for Light Probe
// Sampling").
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// A region's light: a direction, and the radiance times steradian of the region.
struct DirectedLight {
  Direction direction;
  glm::dvec3 flux;
};

/// The map cut `cuts` times in two, along the longer side of every region (its width as long as it
/// is on the sphere at the region's middle), where its power is halved most evenly. A region's
/// light stands at the mean of its directions, weighted by their luminance. There are 2^cuts
/// lights; fewer, if regions are single texels or black.
std::vector<DirectedLight> median_cut(const EnvironmentMap& map, int cuts);

/// The sum over the map's lights, each with a shadow ray: the same for every stream, budget and
/// call. A light stands for a region, so a lobe that is narrower than regions sees few or none of
/// them: the bias for glossy materials is large.
PreparedEstimator median_cut_lights(const EnvironmentMap& map, int cuts);

}  // namespace lightproof
