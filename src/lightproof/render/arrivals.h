// Light that arrives at a shading point unless something blocks it: the last two phases of a batch,
// whatever drew its directions.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/render/scene.h"

namespace lightproof {

/// Up to kCapacity estimates of the radiance that one point reflects, and the rays that decide
/// them.
class Arrivals {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// Begins anew, with so many estimates, which are 0 until light arrives.
  void begin(std::size_t count) {
    assert(count <= kCapacity);
    count_ = count;
    ray_count_ = 0;
  }
  /// What the estimate `sample` is if nothing is in the way: `weight` times the radiance, which
  /// must stay where it is until resolve(). One that does not matter is 0. Once for every estimate,
  /// in their order.
  void add(std::size_t sample, glm::dvec3 position, Direction direction, const Rgb* radiance,
           float weight, bool matters) {
    estimates_[sample] = Rgb(0.0F);
    // Every sample is written; those that do not matter are overwritten by the next.
    rays_[ray_count_] = shadow_ray(position, direction);
    arrivals_[ray_count_] = {radiance, weight, static_cast<std::uint32_t>(sample)};
    __builtin_prefetch(radiance);
    ray_count_ += matters ? 1 : 0;
  }
  /// Asks the scene which rays are blocked.
  void trace(const Scene& scene) { scene.trace({rays_.data(), ray_count_}); }
  /// Collects the radiance along the rays that nothing blocks. Returns each sample's estimate.
  std::span<const Rgb> resolve() {
    for (std::size_t i = 0; i < ray_count_; ++i) {
      const Arrival& arrival = arrivals_[i];
      if (!is_blocked(rays_[i])) estimates_[arrival.sample] = *arrival.radiance * arrival.weight;
    }
    return {estimates_.data(), count_};
  }

  std::span<const ShadowRay> rays() const { return {rays_.data(), ray_count_}; }

 private:
  /// A sample that may bring light, if nothing blocks its ray.
  struct Arrival {
    const Rgb* radiance;
    float weight;
    std::uint32_t sample;
  };

  std::size_t count_ = 0;
  std::size_t ray_count_ = 0;
  std::array<Rgb, kCapacity> estimates_;
  std::array<Arrival, kCapacity> arrivals_;
  std::array<ShadowRay, kCapacity> rays_;
};

}  // namespace lightproof
