#include "lightproof/samplers/alias_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {

AliasLines::AliasLines(const EnvironmentMap& map, TargetDensity target)
    : AliasLines(texel_weights(map, target), target.density_space, map.mapping) {}

AliasLines::AliasLines(const Grid<double>& weights, DensitySpace density_space,
                       const Mapping& mapping)
    : lines_(weights),
      table_(std::span<const double>(run_weights(weights).values())),
      positions_(weights.extent(), density_space, mapping) {}

}  // namespace lightproof
