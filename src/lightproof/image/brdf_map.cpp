#include "lightproof/image/brdf_map.h"

#include <algorithm>

namespace lightproof {

Attributes attributes_of(const BrdfMap& map) {
  return merged({{"software", "Lightproof " LIGHTPROOF_VERSION},
                 {"channels", "R: A, G: B of the directional albedo F0 A + B"},
                 {"axes", "n.v from the left, roughness from the top, at the centres of texels"}},
                map.attributes);
}

Grid<Rgb> picture_of(const BrdfMap& map) {
  Grid<Rgb> picture(map.values.extent());
  std::ranges::transform(map.values.values(), picture.values().begin(),
                         [](glm::vec2 ab) { return Rgb(ab.x, ab.y, 0.0F); });
  return picture;
}

}  // namespace lightproof
