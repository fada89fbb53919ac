// All materials, once.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "lightproof/materials/lambert.h"
#include "lightproof/materials/microfacet.h"
#include "lightproof/materials/modified_phong.h"

namespace lightproof {

/// Visit once per batch, outside the loop. Reflectances are alike in red, green and blue: colour
/// comes from the map.
using Material = std::variant<Lambert, ModifiedPhong, Ggx, BlinnMicrofacet>;

struct MaterialInfo {
  std::string_view name;
  std::string_view description;
  Material material;
  bool
      is_studied;  ///< whether studies measure how estimators converge on it; all others are tested
};

std::span<const MaterialInfo> materials();

/// Throws InputError listing the names if there is none of this name.
const MaterialInfo& material_by_name(std::string_view name);

/// The material of the registry of this name, or one with a parameter of the user's own: "phong:N"
/// with an exponent N from 1 to 1e5, "ggx:R" with a roughness R from 0.02 to 1; all else as in the
/// registry. Throws InputError, which says what there is.
Material material_of(std::string_view text);

}  // namespace lightproof
