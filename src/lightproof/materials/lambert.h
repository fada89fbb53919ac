// Ideal diffuse reflection: f_r = albedo / pi.
#pragma once

#include <algorithm>

#include "lightproof/materials/shading_point.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

struct Lambert {
  double albedo;

  Scattering evaluate(const ShadingPoint& at, Direction light) const {
    return of_cosine(glm::dot(at.frame.normal, light));
  }
  /// Density cos/pi: with it the estimator's weight is the albedo itself.
  DirectionSample sample(const ShadingPoint& at, SquarePoint u) const {
    const Direction local = cosine_hemisphere_from_square(u);
    return {at.frame.to_world(local), of_cosine(local.z)};
  }

 private:
  Scattering of_cosine(double cosine) const {
    const double density = std::max(0.0, cosine) / kPi;
    return {albedo * density, {density}};
  }
};

}  // namespace lightproof
