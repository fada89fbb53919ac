// Direct light of an environment at a point: L_o = ∫ L f_r (n·l)+ V d(omega), by Monte Carlo, in
// batches that pass through four phases: draw, shade, trace, resolve.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/materials/material.h"
#include "lightproof/render/arrivals.h"
#include "lightproof/render/environment_light.h"
#include "lightproof/render/scene.h"
#include "lightproof/samplers/batch.h"

namespace lightproof {

/// What light is estimated, and by which directions. The scene and the light must outlive it.
struct Lighting {
  const Scene* scene;
  const EnvironmentLight* light;
  Material material;
};

/// Up to kCapacity samples on their way through the phases. Each thread has one, and uses it again.
class LightBatch {
 public:
  static constexpr std::size_t kCapacity = Arrivals::kCapacity;

  /// Goes through all four phases over the first `count` of these points, count <= kCapacity.
  /// Returns each sample's estimate of the outgoing radiance; their mean converges to L_o.
  std::span<const Rgb> estimate(const Lighting& lighting, const ShadingPoint& at,
                                const BatchPoints& points, std::size_t count);

  /// The first phase: draws directions and their densities.
  void draw(const Lighting& lighting, const ShadingPoint& at, const BatchPoints& points,
            std::size_t count);
  /// The second phase: weighs directions by k / pdf, finds their texels and makes rays of those
  /// that matter.
  void shade(const Lighting& lighting, const ShadingPoint& at);
  /// The third phase: asks the scene which rays are blocked.
  void trace(const Scene& scene) { arrivals_.trace(scene); }
  /// The last phase: collects the radiance along the rays that nothing blocks. Returns each
  /// sample's estimate.
  std::span<const Rgb> resolve() { return arrivals_.resolve(); }

  std::span<const ShadowRay> rays() const { return arrivals_.rays(); }

 private:
  void fill_from_material(std::size_t count, const Material& material, const ShadingPoint& at);
  void fill_from_sphere(std::size_t count);
  void fill_from_map(std::size_t count, const GuideTable& sampler, const BatchPoints& points);
  Direction direction(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  /// The texels of the positions on the map.
  void locate(Extent map);

  // Of every sample. Apart, so that loops over them run on vectors.
  std::size_t count_ = 0;
  // If not the map is drawn from, the uniform numbers s and u, and then the position on the map.
  std::array<double, kCapacity> s_;
  std::array<double, kCapacity> u_;
  std::array<double, kCapacity> t_;
  std::array<double, kCapacity> x_;
  std::array<double, kCapacity> y_;
  std::array<double, kCapacity> z_;
  std::array<double, kCapacity> pdf_;  ///< per steradian; 0: no sample
  std::array<double, kCapacity> reflected_cosine_;
  std::array<std::int32_t, kCapacity> column_;  ///< column of the texel
  std::array<std::int32_t, kCapacity> row_;
  Arrivals arrivals_;
};

}  // namespace lightproof
