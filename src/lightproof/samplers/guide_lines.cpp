#include "lightproof/samplers/guide_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

constexpr std::size_t kPartsPerRun = 4;

}  // namespace

GuideLines::GuideLines(const EnvironmentMap& map, TargetDensity target)
    : GuideLines(texel_weights(map, target), target.density_space, map.mapping) {}

GuideLines::GuideLines(const Grid<double>& weights, DensitySpace density_space,
                       const Mapping& mapping)
    : lines_(weights),
      table_(run_weights(weights)),
      guides_(table_, kPartsPerRun),
      positions_(weights.extent(), density_space, mapping) {}

}  // namespace lightproof
