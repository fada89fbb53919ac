#include "lightproof/shading/two_maps.h"

#include <algorithm>
#include <cmath>

#include "lightproof/image/lat_long_texels.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/prefilter/diffuse_shading.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/prefilter/specular_comparisons.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kIrradianceExtent = {64, 32};

GeometryTerm geometry_of(TwoMapsForm form) {
  switch (form) {
    case TwoMapsForm::text:
      return GeometryTerm::cosine;
    case TwoMapsForm::program:
      return GeometryTerm::none;
    case TwoMapsForm::corrected:
      break;
  }
  return GeometryTerm::cook_torrance;
}

/// By what the irradiance that the form looks up is multiplied, beside the surface's colour.
double diffuse_factor(const GlossyOnDiffuse& surface, TwoMapsForm form) {
  switch (form) {
    case TwoMapsForm::text:
      return -kPi;
    case TwoMapsForm::program:
      return 1.0;
    case TwoMapsForm::corrected:
      break;
  }
  return mean_transmittance(surface.normal_reflectance) / kPi;
}

Radiance sum_of(const GlossyOnDiffuse& surface, double cosine, glm::dvec3 reflected,
                glm::dvec3 irradiance, TwoMapsForm form) {
  return {schlick_fresnel(surface.normal_reflectance, cosine) * reflected +
          diffuse_factor(surface, form) * surface.colour * irradiance};
}

}  // namespace

double white_reflectivity(double roughness, TwoMapsForm form) {
  const double shininess = half_vector_shininess(roughness);
  switch (form) {
    case TwoMapsForm::text:
      return white_with_cosine_geometry(shininess);
    case TwoMapsForm::program:
      return 2.0 / kPi * white_without_geometry(shininess) /
             (1.0 - half_vector_below_horizon(shininess));
    case TwoMapsForm::corrected:
      break;
  }
  return white_with_cook_torrance(shininess);
}

TwoMaps::TwoMaps(const EnvironmentMap& environment, Extent extent, int levels, TwoMapsForm form)
    : form_(form),
      reflectivity_(
          reflectivity_chain(lat_long_radiance(environment, "shading by precomputed maps"), extent,
                             levels, geometry_of(form))),
      irradiance_(rounded(irradiance_map(environment, kIrradianceExtent).irradiance)) {
  for (int level = 0; level < levels; ++level) {
    const auto white =
        static_cast<float>(white_reflectivity(reflectivity_roughness(level, levels), form));
    for (Rgb& texel : reflectivity_[static_cast<std::size_t>(level)].values()) texel *= white;
  }
}

Radiance TwoMaps::shaded(const GlossyOnDiffuse& surface, Direction normal, Direction view) const {
  const double cosine = std::clamp(glm::dot(normal, view), 0.0, 1.0);
  const double level =
      level_of_reflectivity(surface.roughness, static_cast<int>(reflectivity_.size()));
  const Direction lit = form_ == TwoMapsForm::text ? -normal : normal;
  return sum_of(surface, cosine,
                glm::dvec3(look_up(reflectivity_, reflect_about(view, normal), level)),
                look_up_bilinear(irradiance_, square_from_direction(lit)), form_);
}

Radiance shaded_by_white(const GlossyOnDiffuse& surface, double cosine, TwoMapsForm form) {
  return sum_of(surface, cosine, glm::dvec3(white_reflectivity(surface.roughness, form)),
                glm::dvec3(kPi), form);
}

}  // namespace lightproof
