#include "lightproof/render/scene.h"

#if LIGHTPROOF_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>
#include <stdexcept>

namespace lightproof {
namespace {

static_assert(sizeof(ShadowRay) == sizeof(RTCRay));
static_assert(alignof(ShadowRay) == alignof(RTCRay));
static_assert(offsetof(ShadowRay, near) == offsetof(RTCRay, tnear));
static_assert(offsetof(ShadowRay, direction) == offsetof(RTCRay, dir_x));
static_assert(offsetof(ShadowRay, far) == offsetof(RTCRay, tfar));
static_assert(offsetof(ShadowRay, flags) == offsetof(RTCRay, flags));

/// Half the side of the plane: to a point one radius above it, its horizon lies 1e-4 rad below
/// the true one.
constexpr float kPlaneHalfSide = 1e4F;

#if LIGHTPROOF_EMBREE >= 4
void find_first(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query, nullptr); }

/// Sets tfar of the rays that something blocks to minus infinity.
void find_any(RTCScene scene, std::span<ShadowRay> rays) {
  for (ShadowRay& ray : rays) rtcOccluded1(scene, reinterpret_cast<RTCRay*>(&ray), nullptr);
}
#else
void find_first(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}

/// Sets tfar of the rays that something blocks to minus infinity.
void find_any(RTCScene scene, std::span<ShadowRay> rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(scene, &context, reinterpret_cast<RTCRay*>(rays.data()),
                static_cast<unsigned>(rays.size()), sizeof(ShadowRay));
}
#endif

void attach_sphere(RTCDevice device, RTCScene scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* sphere = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  sphere[0] = sphere[1] = sphere[2] = 0.0F;
  sphere[3] = 1.0F;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void attach_plane(RTCDevice device, RTCScene scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4));
  const float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    corners[3 * i] = signs[i][0] * kPlaneHalfSide;
    corners[3 * i + 1] = signs[i][1] * kPlaneHalfSide;
    corners[3 * i + 2] = -1.0F;
  }
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 1));
  for (unsigned i = 0; i < 4; ++i) indices[i] = i;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

struct Scene::Device {
  RTCDevice device;
  RTCScene scene;
};

Scene::Scene(SceneContent content) : content_(content), device_(std::make_unique<Device>()) {
  // There is no `threads=` in here: Embree would hold the whole process, not only itself, to that
  // number.
  device_->device = rtcNewDevice("set_affinity=0");
  if (device_->device == nullptr) throw std::runtime_error("Embree cannot create a device");
  device_->scene = rtcNewScene(device_->device);
  rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_ROBUST);
  if (content.sphere) attach_sphere(device_->device, device_->scene);
  if (content.plane) attach_plane(device_->device, device_->scene);
  rtcCommitScene(device_->scene);
}

Scene::~Scene() {
  rtcReleaseScene(device_->scene);
  rtcReleaseDevice(device_->device);
}

std::optional<SurfaceHit> Scene::intersect(glm::dvec3 origin, Direction direction) const {
  RTCRayHit query{};
  const ShadowRay ray = shadow_ray(origin, direction);
  query.ray = {ray.origin[0],
               ray.origin[1],
               ray.origin[2],
               0.0F,
               ray.direction[0],
               ray.direction[1],
               ray.direction[2],
               0.0F,
               ray.far,
               ~0U,
               0U,
               0U};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  find_first(device_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const glm::dvec3 position = origin + static_cast<double>(query.ray.tfar) * direction;
  // The exact surface: float distances of far cameras are not good enough to start from.
  const bool on_sphere = content_.sphere && query.hit.geomID == 0;
  const Direction normal = on_sphere ? glm::normalize(position) : Direction(0.0, 0.0, 1.0);
  const glm::dvec3 surface =
      on_sphere ? glm::dvec3(normal) : glm::dvec3(position.x, position.y, -1.0);
  return SurfaceHit{surface + kSurfaceOffset * normal, normal};
}

void Scene::trace(std::span<ShadowRay> rays) const {
  if (rays.empty() || (!content_.sphere && !content_.plane)) return;
  find_any(device_->scene, rays);
}

bool Scene::is_visible(glm::dvec3 origin, Direction direction) const {
  ShadowRay ray = shadow_ray(origin, direction);
  trace({&ray, 1});
  return !is_blocked(ray);
}

}  // namespace lightproof
