#include "lightproof/samplers/texel_places.h"

#include "lightproof/warp/lat_long.h"

namespace lightproof {

TexelPlaces::TexelPlaces(Extent extent, Weighting weighting)
    : extent_(extent),
      weighting_(weighting),
      texel_width_(1.0 / extent.width),
      texel_height_(1.0 / extent.height),
      texels_(static_cast<double>(extent.count())),
      solid_angle_rows_(weighting == Weighting::B ? extent.height : 0) {
  if (weighting == Weighting::A) return;
  for (int y = 0; y < extent.height; ++y) {
    texels_per_steradian_.push_back(1.0 / texel_solid_angle(extent, y));
  }
}

}  // namespace lightproof
