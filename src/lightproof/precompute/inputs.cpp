#include "lightproof/precompute/inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/image/map_identity.h"

namespace lightproof {
namespace {

std::string name_of(PrefilterMethod method) {
  return std::string(
      std::ranges::find(prefilter_methods(), method, &PrefilterMethodInfo::method)->name);
}

}  // namespace

std::vector<RunInput> inputs_of(const EnvironmentMap& map, const PrecomputeRequest& request) {
  const Extent extent = map.radiance.extent();
  std::vector<RunInput> inputs = {
      {"the map", fmt::format("{}x{} {:016x}", extent.width, extent.height, hash_of(map.radiance))},
      {"--projection", std::string(info(request.projection).name)},
      {"--method", name_of(request.method.method)},
      {"--samples", fmt::format("{}", request.method.samples)},
      {"--degree", fmt::format("{}", request.method.degree)}};
  for (const ProductRequest& product : request.products) {
    if (product.product == Product::brdf_map) continue;
    const std::vector<LevelPlan> plans = plan_levels(product, request.projection);
    inputs.push_back(
        {fmt::format("--{}", lightproof::name_of(product.product)),
         fmt::format("{}x{} with {} level{}", plans.front().extent.width,
                     plans.front().extent.height, plans.size(), plans.size() == 1 ? "" : "s")});
  }
  return inputs;
}

}  // namespace lightproof
