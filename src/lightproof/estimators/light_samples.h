// Directions from which light is asked for at a shading point, many at once, whatever drew them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "lightproof/image/environment_map.h"
#include "lightproof/materials/material_batch.h"
#include "lightproof/render/arrivals.h"
#include "lightproof/samplers/batch.h"

namespace lightproof {

/// Up to kCapacity directions, each number in an array of its own. A source of directions fills the
/// first `count` of every array but the last two, and these if the light is not that of the texel.
struct LightSamples {
  static constexpr std::size_t kCapacity = Arrivals::kCapacity;

  std::size_t count = 0;
  alignas(64) std::array<double, kCapacity> x;
  alignas(64) std::array<double, kCapacity> y;
  alignas(64) std::array<double, kCapacity> z;
  /// What k is divided by: the density per steradian, or, of a weighted sample, the density over
  /// the weight. 0: no sample.
  alignas(64) std::array<double, kCapacity> pdf;
  alignas(64) std::array<double, kCapacity> reflected_cosine;  ///< k = f_r (n·l)+
  std::array<std::int32_t, kCapacity> column;                  ///< of the texel
  std::array<std::int32_t, kCapacity> row;
  std::array<Rgb, kCapacity> light;  ///< the radiance, if `has_light`
  bool has_light = false;            ///< whether `light` stands in the place of the texels

  Direction direction(std::size_t i) const { return {x[i], y[i], z[i]}; }
  DirectionArrays directions() const {
    return {std::span(x).first(count), std::span(y).first(count), std::span(z).first(count)};
  }
  /// Where a sampler of maps writes.
  DirectionBatch batch() {
    return {std::span(x).first(count),      std::span(y).first(count),
            std::span(z).first(count),      std::span(pdf).first(count),
            std::span(column).first(count), std::span(row).first(count)};
  }
  void set(std::size_t i, const LightSample& sample) { put(sample, i, batch()); }
  void set(std::size_t i, Direction to) {
    x[i] = to.x;
    y[i] = to.y;
    z[i] = to.z;
  }

  /// Finds the texels of all directions.
  void locate(Extent map);
  /// Asks the material for k in all directions.
  void reflect(const Material& material, const ShadingPoint& at) {
    reflected_cosines(material, at, directions(), std::span(reflected_cosine).first(count));
  }
  /// The estimate k / pdf L V of every sample, by the scene's shadow rays.
  std::span<const Rgb> estimates(const Scene& scene, const Grid<Rgb>& radiance, glm::dvec3 position,
                                 Arrivals& arrivals) const;
};

/// Sets every sample to sample(u) at its point of the batch: direction, density and texel.
template <class Sample>
void draw_each(const BatchPoints& points, LightSamples& samples, const Sample& sample) {
  std::array<double, LightSamples::kCapacity> s;
  std::array<double, LightSamples::kCapacity> t;
  points.fill(0, std::span(s).first(samples.count), std::span(t).first(samples.count));
  for (std::size_t i = 0; i < samples.count; ++i) samples.set(i, sample(SquarePoint{s[i], t[i]}));
}

/// Draws as many samples as `samples.count` says, at the points of a batch, with k and their
/// texels.
using DrawSamples = std::function<void(const BatchPoints& points, LightSamples& samples)>;

/// Makes a source ready for one shading point, once for every estimate; what it takes time for is
/// part of the estimate's time. Both this and the point must outlive what is returned.
using SamplesAt = std::function<DrawSamples(const ShadingPoint& at)>;

/// A source of directions: what it keeps of a map, which must outlive it, and how it gets ready for
/// a material.
struct PreparedSource {
  const EnvironmentMap* map = nullptr;
  std::function<SamplesAt(const Material& material)> bind;
  std::size_t bytes = 0;  ///< memory that it takes beside the map itself
};

}  // namespace lightproof
