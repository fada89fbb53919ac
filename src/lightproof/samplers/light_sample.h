// One sample at a time as a direction with its density per steradian: what a renderer asks of an
// environment light.
#pragma once

#include <concepts>

#include "lightproof/core/measure.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

/// A sampler that chooses a whole texel and then a place in it.
template <class T>
concept TexelSampler = EnvSampler<T> && requires(const T sampler, SquarePoint u) {
  { sampler.draw(u) } -> std::same_as<TexelDraw>;
  { sampler.positions() } -> std::same_as<const TexelPositions&>;
};

/// A sampler whose samples can be begun before they are needed: prepare(u) asks the memory for what
/// finish() then reads, so that a renderer with other work to do, or with several samples to draw,
/// does not wait.
template <class T>
concept PreparingSampler = TexelSampler<T> && requires(const T sampler, SquarePoint u) {
  { sampler.finish(sampler.prepare(u)) } -> std::same_as<TexelDraw>;
};

/// A sampler that says which mapping the square has in which it draws, without which its samples
/// are no directions.
template <class T>
concept MappedSampler = TexelSampler<T> ||(EnvSampler<T>&& requires(const T sampler) {
  { sampler.mapping() } -> std::convertible_to<Mapping>;
});

/// Whether the map of a sampler has the mapping of Lightproof's own frame.
template <MappedSampler Sampler>
bool is_on_plain_map(const Sampler& sampler) {
  if constexpr (TexelSampler<Sampler>) {
    return is_plain(sampler.positions().mapping());
  } else {
    return is_plain(sampler.mapping());
  }
}

/// The sampler's sample at a point as a direction: that of its position and density over the
/// square, to some roundings. Samplers of whole texels need no position for it, and so no inverse
/// trigonometry.
template <MappedSampler Sampler>
LightSample sample_direction(const Sampler& sampler, SquarePoint u) {
  if constexpr (TexelSampler<Sampler>) {
    return sampler.positions().direction(sampler.draw(u));
  } else {
    const TexelSample sample = sampler.sample(u);
    const Mapping& mapping = sampler.mapping();
    if (is_plain(mapping)) {
      return {direction_from_square(sample.at), to_solid_angle(sample.pdf, sample.at), sample.x,
              sample.y};
    }
    return {direction_at(mapping, sample.at), to_solid_angle(mapping, sample.pdf, sample.at),
            sample.x, sample.y};
  }
}

/// The sample that sampler.prepare(u) began as a direction: that of sample_direction(sampler, u).
template <PreparingSampler Sampler, class Prepared>
LightSample finish_direction(const Sampler& sampler, const Prepared& prepared) {
  return sampler.positions().direction(sampler.finish(prepared));
}

}  // namespace lightproof
