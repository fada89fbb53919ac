#include "lightproof/materials/lobe_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightproof/materials/ggx.h"

namespace lightproof {
namespace {

/// Width in radians of what a lobe of normals of this slope mirrors at a cosine of the view:
/// narrower across where the view grazes.
double mirrored_width(double slope, double cosine) { return 2.0 * slope * std::max(cosine, 0.15); }

double width_of(const Material& material, double cosine) {
  if (const auto* phong = std::get_if<ModifiedPhong>(&material)) {
    return 1.0 / std::sqrt(phong->exponent);
  }
  if (const auto* ggx = std::get_if<Ggx>(&material)) {
    return mirrored_width(ggx_alpha(ggx->roughness), cosine);
  }
  if (const auto* blinn = std::get_if<BlinnMicrofacet>(&material)) {
    return mirrored_width(blinn->roughness * blinn->roughness, cosine);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

bool LobeExtent::varies_within(Direction direction, double angle) const {
  constexpr double kPart = 1.0 / 6.0;
  if (angle <= kPart * width) return false;
  const double distance = std::acos(std::clamp(glm::dot(direction, axis), -1.0, 1.0));
  return angle > kPart * std::max(width, distance - angle);
}

LobeExtent lobe_at(const Material& material, const ShadingPoint& at) {
  const double cosine = glm::dot(at.view, at.frame.normal);
  return {2.0 * cosine * at.frame.normal - at.view, width_of(material, cosine)};
}

}  // namespace lightproof
