#include "lightproof/samplers/alias.h"

namespace lightproof {

Alias::Alias(const EnvironmentMap& map, TargetDensity target)
    : table_(CellWeights(map, target)),
      positions_(map.radiance.extent(), target.density_space, map.mapping) {}

}  // namespace lightproof
