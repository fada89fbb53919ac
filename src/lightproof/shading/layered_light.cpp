#include "lightproof/shading/layered_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/image/lat_long_texels.h"
#include "lightproof/image/look_up.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::size_t kTechniques = 3;

glm::dvec3 schlick(glm::dvec3 f0, double cosine) {
  return f0 + (1.0 - f0) * schlick_weight(cosine);
}

/// The coat with a reflectance of its own.
template <class Coat>
Coat with_reflectance(Coat coat, double f0) {
  coat.normal_reflectance = f0;
  return coat;
}

/// The coat's density, and its reflection at F0 = 0 and at F0 = 1: it is linear between them.
struct CoatValue {
  double bias;
  double whole;
  double pdf;
};

CoatValue coat_value(const LayeredSurface& surface, const ShadingPoint& at, Direction light) {
  return std::visit(
      [&](const auto& coat) {
        const Scattering whole = with_reflectance(coat, 1.0).evaluate(at, light);
        return CoatValue{with_reflectance(coat, 0.0).evaluate(at, light).reflected_cosine,
                         whole.reflected_cosine, whole.pdf.value};
      },
      surface.coat);
}

Direction drawn_from_coat(const LayeredSurface& surface, const ShadingPoint& at, SquarePoint u) {
  return std::visit([&](const auto& coat) { return coat.sample(at, u).direction; }, surface.coat);
}

glm::dvec3 base_value(const LayeredSurface& surface, const ShadingPoint& at, double cosine) {
  const double seen =
      surface.share == BaseShare::of_view ? glm::dot(at.frame.normal, at.view) : cosine;
  return surface.albedo / kPi * cosine * (1.0 - schlick(surface.normal_reflectance, seen));
}

glm::dvec3 value_of(const LayeredSurface& surface, const ShadingPoint& at, double cosine,
                    const CoatValue& coat) {
  if (!(cosine > 0.0)) return glm::dvec3(0.0);
  return coat.bias + surface.normal_reflectance * (coat.whole - coat.bias) +
         base_value(surface, at, cosine);
}

}  // namespace

glm::dvec3 reflected_cosine(const LayeredSurface& surface, const ShadingPoint& at,
                            Direction light) {
  return value_of(surface, at, glm::dot(at.frame.normal, light), coat_value(surface, at, light));
}

LayeredLight::LayeredLight(const EnvironmentMap& map, const Scene& scene)
    : map_(&map), scene_(&scene), sampler_(map, on_map({DensitySpace::solid_angle}, map)) {
  require_lat_long(map, "layered light");
}

glm::dvec3 LayeredLight::contribution(const LayeredSurface& surface, const ShadingPoint& at,
                                      Direction light) const {
  const double cosine = glm::dot(at.frame.normal, light);
  if (!(cosine > 0.0)) return glm::dvec3(0.0);
  const CoatValue coat = coat_value(surface, at, light);
  const SquarePoint square = square_from_direction(light);
  const double of_map = to_solid_angle(sampler_.pdf(square), square).value;
  const double mixture = (coat.pdf + cosine / kPi + of_map) / kTechniques;
  if (!(mixture > 0.0) || !scene_->is_visible(at.position, light)) return glm::dvec3(0.0);
  return glm::dvec3(look_up_nearest(map_->radiance, square)) * value_of(surface, at, cosine, coat) /
         mixture;
}

LayeredEstimate LayeredLight::reflected(const LayeredSurface& surface, const ShadingPoint& at,
                                        const RandomStream& stream, std::uint64_t samples) const {
  const std::uint64_t each = samples / kTechniques;
  LayeredEstimate estimate{glm::dvec3(0.0), glm::dvec3(0.0)};
  for (std::size_t technique = 0; technique < kTechniques; ++technique) {
    glm::dvec3 sum(0.0);
    glm::dvec3 squares(0.0);
    for (std::uint64_t i = 0; i < each; ++i) {
      const SquarePoint u = stream.point(technique * each + i);
      const Direction light = technique == 0   ? drawn_from_coat(surface, at, u)
                              : technique == 1 ? at.frame.to_world(cosine_hemisphere_from_square(u))
                                               : direction_from_square(sampler_.sample(u).at);
      const glm::dvec3 value = contribution(surface, at, light);
      sum += value;
      squares += value * value;
    }
    const double n = static_cast<double>(each);
    const glm::dvec3 mean = sum / n;
    // The estimate is the mean of the three techniques' means.
    estimate.radiance += mean / static_cast<double>(kTechniques);
    const glm::dvec3 variance = glm::max(glm::dvec3(0.0), squares / n - mean * mean) / (n - 1.0);
    estimate.standard_error += variance / static_cast<double>(kTechniques * kTechniques);
  }
  estimate.standard_error = glm::sqrt(estimate.standard_error);
  return estimate;
}

}  // namespace lightproof
