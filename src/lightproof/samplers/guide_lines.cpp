#include "lightproof/samplers/guide_lines.h"

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

constexpr std::size_t kPartsPerRun = 4;

}  // namespace

GuideLines::GuideLines(const EnvironmentMap& map, TargetDensity target)
    : GuideLines(texel_weights(map, target), target.density_space) {}

GuideLines::GuideLines(const Grid<double>& weights, DensitySpace density_space)
    : lines_(weights),
      table_(run_weights(weights)),
      guides_(table_, kPartsPerRun),
      positions_(weights.extent(), density_space) {}

}  // namespace lightproof
