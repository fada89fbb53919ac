// The light that a glossy coat on a diffuse base reflects, by brute force: what shading by
// precomputed maps is held against.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <variant>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/materials/microfacet.h"
#include "lightproof/render/scene.h"
#include "lightproof/samplers/guide_table.h"

namespace lightproof {

/// Which cosine the diffuse base's share 1 - F of the light goes by.
enum class BaseShare {
  of_view,   ///< 1 - F(n·v), of the light that leaves
  of_light,  ///< 1 - F(n·l), of the light that enters
};

/// f_r = coat with F0, and albedo/pi (1 - F) below, F by Schlick. Colours linear.
struct LayeredSurface {
  /// The coat; its own reflectance at normal incidence counts for nothing.
  std::variant<Ggx, BlinnMicrofacet> coat;
  glm::dvec3 normal_reflectance;  ///< F0
  glm::dvec3 albedo;              ///< of the base
  BaseShare share = BaseShare::of_view;
};

/// f_r (n·l)+, per steradian.
glm::dvec3 reflected_cosine(const LayeredSurface& surface, const ShadingPoint& at, Direction light);

/// An estimate and its standard error.
struct LayeredEstimate {
  glm::dvec3 radiance;
  glm::dvec3 standard_error;
};

/// One map as a light on a scene; both must outlive it.
class LayeredLight {
 public:
  LayeredLight(const EnvironmentMap& map, const Scene& scene);

  /// L_o = ∫ L f_r (n·l)+ V d(omega), unbiased: a third of the `samples` each from the coat, from
  /// the base (cosine) and from the map (luminance over directions), weighted by the balance
  /// heuristic (Veach and Guibas 1995), past what blocks the rays. At least six samples.
  LayeredEstimate reflected(const LayeredSurface& surface, const ShadingPoint& at,
                            const RandomStream& stream, std::uint64_t samples) const;

 private:
  glm::dvec3 contribution(const LayeredSurface& surface, const ShadingPoint& at,
                          Direction light) const;

  const EnvironmentMap* map_;
  const Scene* scene_;
  GuideTable sampler_;
};

}  // namespace lightproof
