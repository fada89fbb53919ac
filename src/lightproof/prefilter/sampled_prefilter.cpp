#include "lightproof/prefilter/sampled_prefilter.h"

#include <algorithm>
#include <cmath>

#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

glm::dvec3 sum_nearest(const Grid<Rgb>& map, std::span<const LobeSample> samples, Direction axis) {
  const Frame frame = frame_around(axis);
  glm::dvec3 sum(0.0);
  for (const LobeSample& sample : samples) {
    const SquarePoint at = approximate_square_from_direction(frame.to_world(sample.local));
    sum += sample.weight * glm::dvec3(look_up_nearest(map, at));
  }
  return sum;
}

glm::dvec3 sum_filtered(const MipPyramid& pyramid, std::span<const LobeSample> samples, int count,
                        Direction axis) {
  const Frame frame = frame_around(axis);
  const Extent extent = pyramid.base().extent();
  // This is the sine of a texel at the pole: below it, the texels of all levels shrink alike.
  const double least_sine = std::sin(0.5 * kPi / extent.height);
  const double texel_per_sine = 2.0 * kPi * kPi / static_cast<double>(extent.count());
  glm::dvec3 sum(0.0);
  for (const LobeSample& sample : samples) {
    const Direction light = frame.to_world(sample.local);
    const double sine = std::max(least_sine, std::hypot(light.x, light.y));
    const double texels = 1.0 / (count * sample.pdf.value * texel_per_sine * sine);
    const double level = 0.5 * std::log2(std::max(1.0, texels));
    sum += sample.weight * pyramid.trilinear(approximate_square_from_direction(light), level);
  }
  return sum;
}

}  // namespace lightproof
