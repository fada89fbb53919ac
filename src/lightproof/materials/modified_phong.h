// The modified Phong model: f_r = diffuse/pi + specular (n+2)/2pi cos^n(alpha), alpha the angle
// between the light and the mirrored view (Lafortune & Willems 1994; the lecture's "Phong BRDF").
#pragma once

#include <algorithm>

#include "lightproof/materials/shading_point.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

struct ModifiedPhong {
  double diffuse;
  double specular;  ///< diffuse + specular <= 1 conserves energy
  double exponent;

  Scattering evaluate(const ShadingPoint& at, Direction light) const {
    const double share = diffuse / (diffuse + specular);
    const double cosine = std::max(0.0, glm::dot(at.frame.normal, light));
    const double glossy = lobe(at, light);
    return {cosine * (diffuse / kPi + specular * glossy),
            {share * cosine / kPi + (1.0 - share) * glossy * (exponent + 1.0) / (exponent + 2.0)}};
  }

  /// One of the two lobes, chosen in proportion to its reflectance; the lobe around the mirrored
  /// view may go below the surface, where the model reflects nothing.
  DirectionSample sample(const ShadingPoint& at, SquarePoint u) const {
    const double share = diffuse / (diffuse + specular);
    const bool draw_diffuse = u.s < share;
    const double s = draw_diffuse ? u.s / share : (u.s - share) / (1.0 - share);
    const Direction light =
        draw_diffuse
            ? at.frame.to_world(cosine_hemisphere_from_square({s, u.t}))
            : frame_around(mirrored_view(at)).to_world(phong_lobe_from_square({s, u.t}, exponent));
    return {light, evaluate(at, light)};
  }

 private:
  static Direction mirrored_view(const ShadingPoint& at) {
    return reflect_about(at.view, at.frame.normal);
  }
  /// (n+2)/2pi cos^n(alpha).
  double lobe(const ShadingPoint& at, Direction light) const {
    const double cosine = glm::dot(mirrored_view(at), light);
    const double peak = (exponent + 2.0) / (2.0 * kPi);
    return cosine > 0.0 ? peak * cosine_power(cosine, exponent) : 0.0;
  }
};

}  // namespace lightproof
