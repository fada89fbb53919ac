#include "lightproof/render/receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

constexpr std::array<ReceiverInfo, 4> kReceivers = {{
    {"point", "a point with its normal along +z, seen at 45 degrees", {false, false}, false},
    {"sphere", "a sphere in the void", {true, false}, false},
    {"plane", "a horizontal plane", {false, true}, false},
    {"sphere-on-plane", "a sphere on a plane, each blocking the other's light", {true, true}, true},
}};

const glm::dvec3 kEye = {0.0, -5.0, 1.6};
const glm::dvec3 kLookAt = {0.0, 0.0, -0.25};
/// Half the picture's height over its distance.
constexpr double kHalfHeight = 0.30;

bool outline_near(glm::dvec3 position, Direction direction, double angle) {
  const double distance = glm::length(position);
  if (distance <= 1.0 + 2.0 * kSurfaceOffset) return false;
  const double to_centre =
      std::acos(std::clamp(glm::dot(-position / distance, direction), -1.0, 1.0));
  return std::abs(to_centre - std::asin(1.0 / distance)) <= angle;
}

}  // namespace

std::span<const ReceiverInfo> receivers() { return kReceivers; }

const ReceiverInfo& receiver_by_name(std::string_view name) {
  std::string known;
  for (const ReceiverInfo& info : kReceivers) {
    if (info.name == name) return info;
    known += fmt::format(" {}", info.name);
  }
  throw InputError(fmt::format("no receiver is called '{}'; there are:{}", name, known));
}

Direction camera_ray(int x, int y, Extent picture) {
  const Direction forward = glm::normalize(kLookAt - kEye);
  const Direction right = glm::normalize(glm::cross(forward, Direction(0.0, 0.0, 1.0)));
  const Direction up = glm::cross(right, forward);
  const double scale = 2.0 * kHalfHeight / picture.height;
  const double across = (x + 0.5 - 0.5 * picture.width) * scale;
  const double along = (0.5 * picture.height - y - 0.5) * scale;
  return glm::normalize(forward + across * right + along * up);
}

std::vector<Pixel> visible_pixels(const ReceiverInfo& receiver, const Scene& scene,
                                  Extent picture) {
  if (!receiver.content.sphere && !receiver.content.plane) {
    const Direction up = {0.0, 0.0, 1.0};
    return {{0, 0, {{0.0, 0.0, 0.0}, frame_around(up), glm::normalize(Direction(0.0, -1.0, 1.0))}}};
  }
  std::vector<Pixel> pixels;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Direction ray = camera_ray(x, y, picture);
      const auto hit = scene.intersect(kEye, ray);
      if (hit) pixels.push_back({x, y, {hit->position, frame_around(hit->normal), -ray}});
    }
  }
  return pixels;
}

bool straddles_edge(const ReceiverInfo& receiver, const ShadingPoint& point, Direction direction,
                    double angle) {
  const double reach = std::sin(std::min(angle, 1.5));
  if (std::abs(glm::dot(point.frame.normal, direction)) <= reach) return true;
  if (!receiver.occluded) return false;
  const bool on_plane = point.position.z < -1.0 + 2.0 * kSurfaceOffset;
  return on_plane ? outline_near(point.position, direction, angle) : std::abs(direction.z) <= reach;
}

}  // namespace lightproof
