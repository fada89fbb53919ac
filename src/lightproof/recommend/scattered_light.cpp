#include "lightproof/recommend/scattered_light.h"

namespace lightproof {

ScatteredLight scattered(const MapSummary& summary, const Material& material,
                         const ShadingPoint& at, const LobeReach& lobe, Direction also) {
  ScatteredLight light;
  light.nodes = nodes_for(summary, lobe, at.frame.normal, also);
  light.k.resize(light.nodes.size());
  light.pdf.resize(light.nodes.size());
  scatterings(material, at, light.nodes.directions(), {light.k, light.pdf});
  for (std::size_t i = 0; i < light.k.size(); ++i) {
    light.mean += light.k[i] * light.nodes.light[i];
    light.lobes += light.pdf[i] * light.nodes.solid_angle[i];
  }
  return light;
}

}  // namespace lightproof
