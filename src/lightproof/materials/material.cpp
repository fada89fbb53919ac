#include "lightproof/materials/material.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

constexpr std::array kMaterials = {
    MaterialInfo{"lambert", "Lambert, albedo 0.8", Lambert{0.8}, true},
    MaterialInfo{"phong", "modified Phong, diffuse 0.3, specular 0.6, exponent 50",
                 ModifiedPhong{0.3, 0.6, 50.0}, true},
    MaterialInfo{"ggx", "GGX, roughness 0.3, reflectance 0.9 at normal incidence", Ggx{0.3, 0.9},
                 true},
    MaterialInfo{"ggx_rough", "GGX, roughness 0.8, reflectance 0.9 at normal incidence",
                 Ggx{0.8, 0.9}, false},
    MaterialInfo{"blinn",
                 "Blinn's half-vector lobe, roughness 0.5, reflectance 0.9 at normal "
                 "incidence",
                 BlinnMicrofacet{0.5, 0.9}, false},
};

}  // namespace

std::span<const MaterialInfo> materials() { return kMaterials; }

const MaterialInfo& material_by_name(std::string_view name) {
  std::string known;
  for (const MaterialInfo& info : kMaterials) {
    if (info.name == name) return info;
    known += fmt::format(" {}", info.name);
  }
  throw InputError(fmt::format("no material is called '{}'; there are:{}", name, known));
}

}  // namespace lightproof
