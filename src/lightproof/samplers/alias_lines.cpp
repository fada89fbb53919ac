#include "lightproof/samplers/alias_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {

AliasLines::AliasLines(const EnvironmentMap& map, TargetDensity target)
    : AliasLines(texel_weights(map, target), target.weighting) {}

AliasLines::AliasLines(const Grid<double>& weights, Weighting weighting)
    : lines_(weights),
      table_(std::span<const double>(run_weights(weights).values())),
      places_(weights.extent(), weighting) {}

}  // namespace lightproof
