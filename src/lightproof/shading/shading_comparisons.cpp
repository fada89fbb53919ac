#include "lightproof/shading/shading_comparisons.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "lightproof/shading/layered_light.h"
#include "lightproof/shading/metallic_roughness.h"

namespace lightproof {

PublishedComparison white_furnace_comparison(double roughness, double cosine) {
  MetallicRoughness surface;
  surface.roughness = roughness;
  const PrecomputedLight white = {
      glm::dvec3(1.0), integrate_brdf(cosine, roughness, Masking::karis), glm::dvec3(1.0)};
  const auto reflected = [&](DiffuseShare share) {
    return shaded(surface, cosine, white, share).rgb.r;
  };
  return {"002-6",
          "white surface under a white sky: diffuse share 1 - F(n·v) against 1 - (F0 A + B)", 1.0,
          reflected(DiffuseShare::published), reflected(DiffuseShare::remaining)};
}

double white_along_normal(const GlossyOnDiffuse& surface) {
  const LayeredSurface layered = {BlinnMicrofacet{surface.roughness, 0.0},
                                  glm::dvec3(surface.normal_reflectance), surface.colour,
                                  BaseShare::of_light};
  const ShadingPoint at = {glm::dvec3(0.0), frame_around({0.0, 0.0, 1.0}), {0.0, 0.0, 1.0}};
  const auto ring = [&](double cosine) {
    const Direction light = {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    return 2.0 * kPi * reflected_cosine(layered, at, light).r;
  };
  // In two parts, for the kink of Cook and Torrance's min(1, 2 n·l).
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 31>;
  return Kronrod::integrate(ring, 0.0, 0.5, 10, 1e-11) +
         Kronrod::integrate(ring, 0.5, 1.0, 10, 1e-11);
}

PublishedComparison two_maps_comparison(TwoMapsForm published) {
  const GlossyOnDiffuse surface = {0.5, 0.04, glm::dvec3(1.0)};
  const auto reflected = [&](TwoMapsForm form) {
    return shaded_by_white(surface, 1.0, form).rgb.r;
  };
  return {
      "004-15",
      published == TwoMapsForm::text
          ? "white surface under a white sky by the equation of two hemispheres"
          : "white surface under a white sky by the program's two maps, F times one and c times "
            "the other",
      white_along_normal(surface), reflected(published), reflected(TwoMapsForm::corrected)};
}

std::vector<PublishedComparison> shading_comparisons() {
  return {white_furnace_comparison(1.0, 0.5), two_maps_comparison(TwoMapsForm::text),
          two_maps_comparison(TwoMapsForm::program)};
}

}  // namespace lightproof
