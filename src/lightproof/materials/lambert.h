// Ideal diffuse reflection: f_r = albedo / pi.
#pragma once

#include <algorithm>

#include "lightproof/materials/shading_point.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

struct Lambert {
  double albedo;

  /// f_r (n·l)+, per steradian.
  double reflected_cosine(const ShadingPoint& at, Direction light) const {
    return albedo / kPi * std::max(0.0, glm::dot(at.frame.normal, light));
  }
  /// Density cos/pi: with it the estimator's weight is the albedo itself.
  DirectionSample sample(const ShadingPoint& at, SquarePoint u) const {
    const Direction local = cosine_hemisphere_from_square(u);
    return {at.frame.to_world(local), cosine_hemisphere_pdf(local)};
  }
  PerSteradian pdf(const ShadingPoint& at, Direction light) const {
    return {std::max(0.0, glm::dot(at.frame.normal, light)) / kPi};
  }
};

}  // namespace lightproof
