#include "lightproof/prefilter/mip_pyramid.h"

#include <algorithm>
#include <cmath>

#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/resample.h"

namespace lightproof {

MipPyramid::MipPyramid(const Grid<Rgb>& map) : base_(&map) {
  for (Extent extent = map.extent(); extent.count() > 1;) {
    extent = {std::max(1, extent.width / 2), std::max(1, extent.height / 2)};
    smaller_.push_back(resampled(level(smaller_.size()), extent));
  }
}

glm::dvec3 MipPyramid::trilinear(SquarePoint at, double level_of_detail) const {
  const double last = static_cast<double>(smaller_.size());
  const double clamped = std::clamp(level_of_detail, 0.0, last);
  const auto finer = static_cast<std::size_t>(clamped);
  const double between = clamped - static_cast<double>(finer);
  const glm::dvec3 value = look_up_bilinear(level(finer), at);
  if (between == 0.0) return value;
  return (1.0 - between) * value + between * look_up_bilinear(level(finer + 1), at);
}

}  // namespace lightproof
