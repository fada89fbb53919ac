#include "lightproof/materials/material.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
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

/// Materials with a parameter of the user's own.
constexpr double kMostExponent = 1e5;
constexpr double kLeastRoughness = 0.02;

/// The number from `least` to `most` that is the whole text; none if there is none.
std::optional<double> number_in(std::string_view text, double least, double most) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !(number >= least && number <= most)) return std::nullopt;
  return number;
}

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

Material material_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return material_by_name(text).material;
  const std::string_view name = text.substr(0, colon);
  const std::string_view parameter = text.substr(colon + 1);
  if (name == "phong") {
    if (const auto exponent = number_in(parameter, 1.0, kMostExponent)) {
      auto phong = std::get<ModifiedPhong>(material_by_name(name).material);
      phong.exponent = *exponent;
      return phong;
    }
    throw InputError(fmt::format("'{}': the exponent of phong:N is a number from 1 to {:g}", text,
                                 kMostExponent));
  }
  if (name == "ggx") {
    if (const auto roughness = number_in(parameter, kLeastRoughness, 1.0)) {
      auto ggx = std::get<Ggx>(material_by_name(name).material);
      ggx.roughness = *roughness;
      return ggx;
    }
    throw InputError(fmt::format("'{}': the roughness of ggx:R is a number from {:g} to 1", text,
                                 kLeastRoughness));
  }
  throw InputError(
      fmt::format("no material '{}' has a parameter; there are phong:N, for example phong:50, and "
                  "ggx:R, for example ggx:0.3",
                  text));
}

}  // namespace lightproof
