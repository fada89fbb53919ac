#include "lightproof/precompute/request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "lightproof/core/error.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {
namespace {

constexpr std::array<ProductInfo, 4> kProducts = {{
    {Product::irradiance, "irradiance", "E/pi of every normal, for diffuse reflection"},
    {Product::specular, "specular", "prefiltered by GGX, a roughness a level, for the split sum"},
    {Product::reflectivity, "reflectivity",
     "prefiltered by Blinn's half-vector lobe, a roughness a level"},
    {Product::brdf_map, "brdf-map",
     "scale and bias of the split sum over view angle and roughness"},
}};

/// The names of the maskings in the order of the enumeration.
constexpr std::array<std::string_view, 3> kMaskings = {"karis", "separable", "height-correlated"};

/// As many as 512 x 256 texels or faces of 256 x 256 have without a side of 0.
constexpr int kSpecularLevels = 9;

int level_count(const ProductRequest& request, Extent extent) {
  if (request.product == Product::irradiance) return 1;
  if (request.levels) return *request.levels;
  const int usual = request.product == Product::specular ? kSpecularLevels : kReflectivityLevels;
  return std::min(usual, most_levels(extent));
}

double roughness_of(Product product, int level, int levels) {
  return product == Product::specular ? level_roughness(levels)[static_cast<std::size_t>(level)]
                                      : reflectivity_roughness(level, levels);
}

}  // namespace

std::span<const ProductInfo> products() { return kProducts; }

std::string_view name_of(Product product) {
  return kProducts[static_cast<std::size_t>(product)].name;
}

Extent default_extent(Product product, Projection projection) {
  if (product == Product::brdf_map) return {256, 256};
  const int height = product == Product::irradiance ? 32 : 256;
  return is_cube(projection) ? Extent{height / 2, height / 2} : Extent{2 * height, height};
}

std::optional<Lobe> lobe_of(Product product, double roughness) {
  if (product == Product::specular) return ggx_lobe(roughness);
  return HalfVectorLobe{half_vector_shininess(roughness)};
}

std::vector<LevelPlan> plan_levels(const ProductRequest& request, Projection projection) {
  const Product product = request.product;
  const Extent extent = request.extent.value_or(default_extent(product, projection));
  check_map_size(projection, extent);
  const int levels = level_count(request, extent);
  check_level_count(extent, levels);
  std::vector<LevelPlan> plans;
  for (int level = 0; level < levels; ++level) {
    LevelPlan& plan = plans.emplace_back(LevelPlan{product, level, level_extent(extent, level)});
    if (product == Product::irradiance) {
      plan.lobe = PhongLobe{1.0};  // cos/pi
      continue;
    }
    plan.roughness = roughness_of(product, level, levels);
    plan.lobe = lobe_of(product, *plan.roughness);
  }
  return plans;
}

std::string_view name_of(Masking masking) { return kMaskings[static_cast<std::size_t>(masking)]; }

Masking masking_by_name(std::string_view name) {
  const auto found = std::find(kMaskings.begin(), kMaskings.end(), name);
  if (found == kMaskings.end()) {
    throw InputError(
        fmt::format("no masking is called '{}'; there are: {}", name, fmt::join(kMaskings, ", ")));
  }
  return static_cast<Masking>(found - kMaskings.begin());
}

}  // namespace lightproof
