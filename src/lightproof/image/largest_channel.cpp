#include "lightproof/image/largest_channel.h"

#include <algorithm>

namespace lightproof {

EnvironmentMap map_of_largest_channel(EnvironmentMap map) {
  for (Rgb& rgb : map.radiance.values()) rgb = Rgb(std::max({rgb.r, rgb.g, rgb.b}));
  map.weights = kRec709;
  return map;
}

}  // namespace lightproof
