#include "lightproof/accuracy/exact_light.h"

#include <variant>

#include "lightproof/core/parallel.h"
#include "lightproof/materials/lobe_extent.h"

namespace lightproof {
namespace {

/// On texels of h = 2 pi/1024 the middle is off by h^2/24, 2e-6, of a function as smooth as a
/// cosine: less than any error that is charted. Smaller maps have fewer texels to save at.
reference::CellRule rule_for(Extent map) {
  return map.width >= 1024 ? reference::CellRule::adaptive : reference::CellRule::gauss;
}

}  // namespace

reference::Kernel kernel_at(const ReceiverInfo& receiver, const Scene& scene,
                            const Material& material, const ShadingPoint& point) {
  return {
      [material, point](Direction light) {
        return std::visit(
            [&](const auto& surface) -> reference::KernelValue {
              const Scattering at = surface.evaluate(point, light);
              if (at.reflected_cosine <= 0.0) return {};
              return {at.reflected_cosine, at.pdf.value};
            },
            material);
      },
      [&receiver, point, lobe = lobe_at(material, point)](Direction light, double angle) {
        return lobe.varies_within(light, angle) || straddles_edge(receiver, point, light, angle);
      },
      [&scene, point](Direction light) {
        return glm::dot(point.frame.normal, light) > 0.0 && scene.is_visible(point.position, light);
      }};
}

std::vector<std::vector<reference::LightMoments>> exact_light(
    std::span<const Grid<double>> luminances, const ReceiverInfo& receiver, const Scene& scene,
    const Material& material, std::span<const Pixel> pixels) {
  std::vector<std::vector<reference::LightMoments>> moments(
      luminances.size(), std::vector<reference::LightMoments>(pixels.size()));
  parallel_for(pixels.size(), [&](std::size_t pixel) {
    const auto kernel = kernel_at(receiver, scene, material, pixels[pixel].point);
    // The kernel is the costly part: maps of one size that follow each other share it.
    for (std::size_t first = 0; first < luminances.size();) {
      std::size_t end = first + 1;
      while (end < luminances.size() && luminances[end].extent() == luminances[first].extent())
        ++end;
      const auto group = reference::light_moments(kernel, luminances.subspan(first, end - first),
                                                  {}, rule_for(luminances[first].extent()));
      for (std::size_t map = first; map < end; ++map) moments[map][pixel] = group[map - first];
      first = end;
    }
  });
  return moments;
}

}  // namespace lightproof
