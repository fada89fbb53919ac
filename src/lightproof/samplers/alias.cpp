#include "lightproof/samplers/alias.h"

namespace lightproof {

Alias::Alias(const EnvironmentMap& map, TargetDensity target)
    : table_(CellWeights(map, target)), places_(map.radiance.extent(), target.weighting) {}

}  // namespace lightproof
