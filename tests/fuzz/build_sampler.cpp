// Every sampler of the registry on maps of any floats: it is built, or refuses the map in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/samplers/registry.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_map.h"

namespace lightproof::fuzz {
namespace {

/// Whether every texel has a luminance that a density can be in proportion to.
bool has_density(const EnvironmentMap& map, LuminanceWeights weights) {
  return std::ranges::all_of(luminance_of(map, weights).values(), [](double luminance) {
    return luminance >= 0.0 && std::isfinite(luminance);
  });
}

void build(const SamplerInfo& info, const EnvironmentMap& map, DensitySpace density_space) {
  const TargetDensity target = on_map(info.target(density_space), map);
  const bool is_built = accepts([&] {
    const AnySampler any = info.make(map, density_space);
    std::visit(
        [&](const auto& sampler) {
          // Wherever it is asked for, in the map or not.
          for (const double s : {0.0, 0.3, 1.0, -1.0, 2.0, 1e300}) {
            const double pdf = sampler.pdf({s, 0.7}).value;
            if (!info.known_defects && !(pdf >= 0.0)) {
              fail(fmt::format("{}: density {} at s = {}", info.name, pdf, s));
            }
          }
        },
        any);
  });
  if (is_built && !has_density(map, target.weights)) {
    fail(fmt::format("{} was built of what is no luminance", info.name));
  }
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof;
  fuzz::Input input(data, size);
  const DensitySpace density_space = fuzz::density_space(input);
  const EnvironmentMap map = fuzz::small_map(input, fuzz::Values::any);
  for (const SamplerInfo& info : samplers()) fuzz::build(info, map, density_space);
  return 0;
}
