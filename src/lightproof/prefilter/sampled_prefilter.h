// Prefiltering by sampling: for every direction the map is looked up at the same directions around
// it, and the values are summed with their weights.
#pragma once

#include <span>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/prefilter/lobe_samples.h"
#include "lightproof/prefilter/mip_pyramid.h"

namespace lightproof {

/// The value at one axis, each sample looked up in the texel that it falls into.
glm::dvec3 sum_nearest(const Grid<Rgb>& map, std::span<const LobeSample> samples, Direction axis);

/// The value at one axis, each sample looked up in the level of the pyramid whose texels are as
/// large as the solid angle that the sample stands for, 1/(count pdf): Křivánek & Colbert 2008,
/// "Real-time Shading with Filtered Importance Sampling". `count` is the number of samples that
/// were drawn, those below the horizon included.
glm::dvec3 sum_filtered(const MipPyramid& pyramid, std::span<const LobeSample> samples, int count,
                        Direction axis);

}  // namespace lightproof
