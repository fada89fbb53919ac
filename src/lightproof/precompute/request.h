// What is to be made of an environment map.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/lobe.h"
#include "lightproof/prefilter/prefilter.h"

namespace lightproof {

/// A map that an engine loads.
enum class Product {
  irradiance,    ///< E/pi of every normal: what a white Lambertian surface reflects
  specular,      ///< the first part of the split sum: GGX with n = v = r, a roughness a level
  reflectivity,  ///< Blinn's half-vector lobe at n = v, roughness (i + 1/2)/levels
  brdf_map,      ///< the second part of the split sum, of no environment
};

struct ProductInfo {
  Product product;
  std::string_view name;  ///< "brdf-map": its option, and the stem of its files
  std::string_view description;
};

std::span<const ProductInfo> products();
std::string_view name_of(Product product);

struct ProductRequest {
  Product product;
  std::optional<Extent> extent = std::nullopt;  ///< of level 0, of one face; or default_extent()
  std::optional<int> levels = std::nullopt;     ///< of specular and reflectivity maps
};

struct PrecomputeRequest {
  std::vector<ProductRequest> products;  ///< each product once
  PrefilterSettings method = {};
  Projection projection = Projection::lat_long;
  Masking masking = Masking::height_correlated;  ///< of the BRDF map
};

/// 512 x 256 (specular, reflectivity) and 64 x 32 (irradiance), or faces of half the height; a BRDF
/// map measures 256 x 256.
Extent default_extent(Product product, Projection projection);

/// What a level of this roughness in [0,1] is prefiltered by: of specular and reflectivity maps.
std::optional<Lobe> lobe_of(Product product, double roughness);

/// One level of a product.
struct LevelPlan {
  Product product;
  int level = 0;
  Extent extent;                                   ///< of one face
  std::optional<double> roughness = std::nullopt;  ///< none of an irradiance map
  std::optional<Lobe> lobe = std::nullopt;         ///< none of a mirror
};

/// The levels of a product other than a BRDF map, the finest first. Throws InputError if the size
/// is none that a map may have, or has not so many levels.
std::vector<LevelPlan> plan_levels(const ProductRequest& product, Projection projection);

std::string_view name_of(Masking masking);
/// Throws InputError listing the names if there is none of this name.
Masking masking_by_name(std::string_view name);

}  // namespace lightproof
