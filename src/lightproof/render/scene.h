// The geometry that receives and blocks light: nothing, a unit sphere, the plane below it, or
// both. The only file, with its source, that knows Embree.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "lightproof/core/direction.h"

namespace lightproof {

/// A ray in Embree's own layout (RTCRay), so that batches are handed over without a copy.
struct alignas(16) ShadowRay {
  float origin[3];
  float near;
  float direction[3];
  float time;
  float far;  ///< infinite before tracing; negative after it if something is in the way
  unsigned int mask;
  unsigned int id;
  unsigned int flags;
};

/// A ray from the point that nothing but the scene ends.
inline ShadowRay shadow_ray(glm::dvec3 origin, Direction direction) {
  return {
      {static_cast<float>(origin.x), static_cast<float>(origin.y), static_cast<float>(origin.z)},
      0.0F,
      {static_cast<float>(direction.x), static_cast<float>(direction.y),
       static_cast<float>(direction.z)},
      0.0F,
      std::numeric_limits<float>::infinity(),
      ~0U,
      0U,
      0U};
}

/// Whether something blocks a ray that went through Scene::trace().
inline bool is_blocked(const ShadowRay& ray) { return ray.far < 0.0F; }

/// Where a ray meets a surface.
struct SurfaceHit {
  glm::dvec3 position;  ///< moved off the surface by kSurfaceOffset along the normal
  Direction normal;
};

/// Shadow rays start this far above the surface, in units of the sphere's radius: enough that a
/// convex surface never shadows itself, too little to see.
inline constexpr double kSurfaceOffset = 1e-4;

/// What a scene holds: a unit sphere around the origin, and the plane z = -1 on which it stands.
struct SceneContent {
  bool sphere = false;
  bool plane = false;
};

/// Surfaces that rays can meet, in an acceleration structure.
class Scene {
 public:
  explicit Scene(SceneContent content);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  SceneContent content() const { return content_; }
  /// The first surface along the ray; safe from many threads.
  std::optional<SurfaceHit> intersect(glm::dvec3 origin, Direction direction) const;
  /// Marks the rays that are blocked; safe from many threads.
  void trace(std::span<ShadowRay> rays) const;
  /// Whether nothing blocks the ray; safe from many threads.
  bool is_visible(glm::dvec3 origin, Direction direction) const;

 private:
  struct Device;
  SceneContent content_;
  std::unique_ptr<Device> device_;
};

}  // namespace lightproof
