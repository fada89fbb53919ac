#include "lightproof/samplers/alias.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {

Alias::Alias(const EnvironmentMap& map, TargetDensity target)
    : table_(texel_weights(map, target).values()),
      places_(map.radiance.extent(), target.weighting) {}

}  // namespace lightproof
