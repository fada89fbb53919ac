// Which other convention would make a rejected dump right: other axes, a mirror image, another
// density, other weights of the luminance.
#pragma once

#include <vector>

#include "lightproof/dump/sample_dump.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"
#include "lightproof/results/recognition.h"

namespace lightproof {

/// Changes after which the samples fit the map, the likeliest first; at most three. None if the
/// samples fit as they are, or nothing does. `target` is what they are declared to have, in axes
/// that are already Lightproof's.
std::vector<Recognition> recognise(const SampleDump& dump, const EnvironmentMap& map,
                                   TargetDensity target);

}  // namespace lightproof
