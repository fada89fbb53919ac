#include "lightproof/recommend/lobe_share.h"

#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/warp/frames.h"

namespace lightproof {
namespace {

constexpr int kAngles = 4000;
/// In radians; the narrowest lobe, of a GGX roughness of 0.02, is 4e-4 wide.
constexpr double kLeastAngle = 1e-7;

}  // namespace

double lobe_share(const Material& material) {
  const Direction normal = {0.0, 0.0, 1.0};
  const ShadingPoint at = {glm::dvec3(0.0), frame_around(normal), normal};
  const double step = std::log(0.5 * kPi / kLeastAngle) / kAngles;
  double sum = 0.0;
  double square = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = kLeastAngle * std::exp((i + 0.5) * step);
    const Direction light = {std::sin(angle), 0.0, std::cos(angle)};
    const double reflected = std::visit(
        [&](const auto& surface) { return surface.evaluate(at, light).reflected_cosine; },
        material);
    const double solid_angle = 2.0 * kPi * std::sin(angle) * angle * step;
    sum += reflected * solid_angle;
    square += reflected * reflected * solid_angle;
  }
  return sum * sum / square / kSphere;
}

}  // namespace lightproof
