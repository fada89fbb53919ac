#include "lightproof/samplers/guide_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

constexpr std::size_t kPartsPerRun = 4;

}  // namespace

GuideLines::GuideLines(const EnvironmentMap& map, TargetDensity target)
    : GuideLines(texel_weights(map, target), target.weighting) {}

GuideLines::GuideLines(const Grid<double>& weights, Weighting weighting)
    : lines_(weights),
      table_(run_weights(weights)),
      guides_(table_, kPartsPerRun),
      places_(weights.extent(), weighting) {}

}  // namespace lightproof
