// Which other convention would make a rejected dump right: other axes, a mirror image, another
// density, other weights of the luminance, positions that are half a texel off, a density that is
// per something else.
#pragma once

#include <vector>

#include "lightproof/check/direction_target.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"
#include "lightproof/results/recognition.h"

namespace lightproof {

/// What samples are declared to be drawn from.
struct DeclaredMap {
  const EnvironmentMap* map;  ///< grey of the largest channel, if that is the declared luminance
  TargetDensity target;       ///< on_map()
  /// The map in its colours; null if it is `map`.
  const EnvironmentMap* colours = nullptr;
};

/// Changes after which the samples fit the map, the likeliest first, at most three, and after them
/// what the densities that come with the samples would be right for. None if the samples fit as
/// they are, or nothing does.
std::vector<Recognition> recognise(const SampleDump& dump, const DeclaredMap& declared);

/// Other axes in which the samples fit a distribution over directions, and what their densities
/// would be right for.
std::vector<Recognition> recognise(const SampleDump& dump, const DirectionTarget& target);

}  // namespace lightproof
