#include "lightproof/shading/metallic_roughness.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>

#include "lightproof/image/lat_long_texels.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kBrdfExtent = {256, 256};
constexpr Extent kDiffuseExtent = {64, 32};
constexpr double kGamma = 2.2;

double level_of(double roughness, std::size_t levels, LevelForm form) {
  const int count = static_cast<int>(levels);
  return form == LevelForm::published ? level_of_roughness_published(roughness, count)
                                      : level_of_roughness(roughness, count);
}

/// The texels on both sides of a coordinate, and the weight of the second.
struct Neighbours {
  int first;
  int second;
  double between;
};

Neighbours neighbours(double coordinate, int count) {
  const double position = std::clamp(coordinate * count - 0.5, 0.0, count - 1.0);
  const int first = static_cast<int>(position);
  return {first, std::min(first + 1, count - 1), position - first};
}

}  // namespace

glm::dvec3 normal_reflectance(const MetallicRoughness& surface) {
  return glm::mix(glm::dvec3(0.16 * surface.reflectance * surface.reflectance), surface.base_colour,
                  surface.metallic);
}

Radiance shaded(const MetallicRoughness& surface, double cosine, const PrecomputedLight& light,
                DiffuseShare share) {
  const glm::dvec3 f0 = normal_reflectance(surface);
  const glm::dvec3 specular = f0 * light.brdf.scale + light.brdf.bias;
  const glm::dvec3 coat =
      share == DiffuseShare::published ? f0 + (1.0 - f0) * schlick_weight(cosine) : specular;
  const glm::dvec3 below = (1.0 - coat) * (1.0 - surface.metallic);
  return {surface.emission + below * surface.base_colour * light.diffuse +
          light.prefiltered * specular};
}

glm::dvec3 display_encoded(Radiance radiance) {
  return glm::pow(radiance.rgb, glm::dvec3(1.0 / kGamma));
}

glm::dvec3 display_decoded(glm::dvec3 encoded) { return glm::pow(encoded, glm::dvec3(kGamma)); }

ScaleBias look_up(const Grid<ScaleBias>& map, double cosine, double roughness) {
  const Neighbours x = neighbours(cosine, map.extent().width);
  const Neighbours y = neighbours(roughness, map.extent().height);
  const auto mixed = [](ScaleBias a, ScaleBias b, double between) {
    return ScaleBias{std::lerp(a.scale, b.scale, between), std::lerp(a.bias, b.bias, between)};
  };
  return mixed(mixed(map(x.first, y.first), map(x.second, y.first), x.between),
               mixed(map(x.first, y.second), map(x.second, y.second), x.between), y.between);
}

MetallicRoughnessMaps::MetallicRoughnessMaps(const EnvironmentMap& environment, Extent extent,
                                             int levels)
    : chain_(
          ggx_chain(lat_long_radiance(environment, "shading by precomputed maps"), extent, levels)),
      brdf_(brdf_map(kBrdfExtent, Masking::height_correlated)),
      diffuse_(rounded(diffuse_map(irradiance_map(environment, kDiffuseExtent)).radiance)) {}

PrecomputedLight MetallicRoughnessMaps::look_up(double roughness, Direction normal, Direction view,
                                                LevelForm form) const {
  const double cosine = std::clamp(glm::dot(normal, view), 0.0, 1.0);
  const double level = level_of(roughness, chain_.size(), form);
  return {glm::dvec3(lightproof::look_up(chain_, reflect_about(view, normal), level)),
          lightproof::look_up(brdf_, cosine, roughness),
          look_up_bilinear(diffuse_, square_from_direction(normal))};
}

Radiance shaded(const MetallicRoughness& surface, const MetallicRoughnessMaps& maps,
                Direction normal, Direction view, LevelForm form) {
  const double cosine = std::max(0.0, glm::dot(normal, view));
  return shaded(surface, std::min(cosine, 1.0),
                maps.look_up(surface.roughness, normal, view, form));
}

namespace published {

SquarePoint position_on_map(Direction direction) {
  const double turns = std::atan2(direction.y, direction.x) / (2.0 * kPi);
  return {1.0 - (turns - std::floor(turns)), std::acos(-direction.z) / kPi};
}

SquarePoint background_position(SquarePoint texture_coordinate) {
  return {1.0 - texture_coordinate.s, texture_coordinate.t};
}

}  // namespace published

SquarePoint background_coordinate(Direction direction) {
  const double turns = std::atan2(direction.y, direction.x) / (2.0 * kPi);
  return {turns - std::floor(turns), std::acos(-direction.z) / kPi};
}

}  // namespace lightproof
