// Rough mirrors: f_r = F D G / (4 (n.v)(n.l)) over a distribution of microfacet normals (Torrance &
// Sparrow 1967; Cook & Torrance 1982; Walter et al. 2007). Light is reflected once: what a second
// microfacet would catch is lost.
#pragma once

#include <algorithm>

#include "lightproof/materials/blinn_half_vector.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/materials/ggx_sampling.h"
#include "lightproof/materials/shading_point.h"

namespace lightproof {

/// GGX with Smith's masking and Schlick's Fresnel factor.
struct Ggx {
  double roughness;           ///< in (0, 1]; alpha is its square
  double normal_reflectance;  ///< F0; 1 is a mirror's at every angle
  SmithMasking masking = SmithMasking::height_correlated;
  MicrofacetSampling sampling = MicrofacetSampling::bounded_caps;

  Scattering evaluate(const ShadingPoint& at, Direction light) const {
    return of_local(at.frame.to_local(at.view), at.frame.to_local(light));
  }
  /// A direction may go below the surface, where the model reflects nothing.
  DirectionSample sample(const ShadingPoint& at, SquarePoint u) const {
    const Direction view = at.frame.to_local(at.view);
    const Direction normal = ggx_normal_from_square(sampling, ggx_alpha(roughness), view, u);
    const Direction light = reflect_about(view, normal);
    return {at.frame.to_world(light), of_local(view, light)};
  }

 private:
  Scattering of_local(Direction view, Direction light) const {
    const double alpha = ggx_alpha(roughness);
    const HalfVector half = half_vector(view, light);
    const PerSteradian pdf = ggx_reflected_pdf(sampling, alpha, view, half);
    if (!(light.z > 0.0)) return {0.0, pdf};
    return {schlick_fresnel(normal_reflectance, half.cosine) *
                ggx_normal_distribution(alpha, half.normal) *
                smith_visibility(masking, alpha, view.z, light.z) * light.z,
            pdf};
  }
};

/// Blinn's lobe with the masking of Cook and Torrance, which takes the surface for V-shaped
/// grooves, and Schlick's Fresnel factor. Drawn by D(h) (n.h).
struct BlinnMicrofacet {
  double roughness;           ///< in (0, 1]; the shininess is 2/R^4 - 2
  double normal_reflectance;  ///< F0; 1 is a mirror's at every angle

  Scattering evaluate(const ShadingPoint& at, Direction light) const {
    return of_local(at.frame.to_local(at.view), at.frame.to_local(light));
  }
  /// A direction may go below the surface, where the model reflects nothing.
  DirectionSample sample(const ShadingPoint& at, SquarePoint u) const {
    const Direction view = at.frame.to_local(at.view);
    const Direction normal = blinn_normal_from_square(blinn_shininess(roughness), u);
    const Direction light = reflect_about(view, normal);
    return {at.frame.to_world(light), of_local(view, light)};
  }

 private:
  Scattering of_local(Direction view, Direction light) const {
    const HalfVector half = half_vector(view, light);
    const Direction upper = half.normal.z < 0.0 ? -half.normal : half.normal;
    const double distribution = blinn_normal_distribution(blinn_shininess(roughness), upper);
    const PerSteradian pdf = reflected_density({distribution * upper.z}, half.cosine);
    if (!(light.z > 0.0)) return {0.0, pdf};
    const double masking = std::min(1.0, 2.0 * upper.z * std::min(view.z, light.z) / half.cosine);
    return {
        schlick_fresnel(normal_reflectance, half.cosine) * distribution * masking / (4.0 * view.z),
        pdf};
  }
};

}  // namespace lightproof
