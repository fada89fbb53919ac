// Radiance as a function of direction: what sums over directions ask for.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>

#include "lightproof/core/direction.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/image/look_up.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

/// Called with a unit vector, gives red, green and blue.
template <class Function>
concept RadianceFunction = requires(const Function& radiance, Direction direction) {
  { radiance(direction) } -> std::convertible_to<glm::dvec3>;
};

/// A map's texels, each constant. The map must outlive it.
class NearestRadiance {
 public:
  explicit NearestRadiance(const EnvironmentMap& map)
      : radiance_(lat_long_radiance(map, "prefiltering")) {}

  glm::dvec3 operator()(Direction direction) const {
    return look_up_nearest(radiance_, square_from_direction(direction));
  }

 private:
  const Grid<Rgb>& radiance_;
};

}  // namespace lightproof
