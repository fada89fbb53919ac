#include "lightproof/samplers/guide_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {

GuideLines::GuideLines(const EnvironmentMap& map, TargetDensity target)
    : GuideLines(texel_weights(map, target), target.weighting) {}

GuideLines::GuideLines(const Grid<double>& weights, Weighting weighting)
    : lines_(weights),
      table_(run_weights(weights)),
      guides_(table_),
      places_(weights.extent(), weighting) {}

}  // namespace lightproof
