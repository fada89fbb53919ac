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

/// A sampler that can ask the memory for what a sample at this point will read, so that a renderer
/// with several samples to draw waits once for all of them.
template <class T>
concept PrefetchingSampler = EnvSampler<T> && requires(const T sampler, SquarePoint u) {
  sampler.prefetch(u);
};

/// Whether the map of a sampler has the mapping of Lightproof's own frame.
template <EnvSampler Sampler>
bool is_on_plain_map(const Sampler& sampler) {
  if constexpr (TexelSampler<Sampler>) {
    return is_plain(sampler.positions().mapping());
  } else {
    return true;
  }
}

/// The sampler's sample at a point as a direction: that of its position and density over the
/// square, to some roundings. Samplers of whole texels need no position for it, and so no inverse
/// trigonometry.
template <EnvSampler Sampler>
LightSample sample_direction(const Sampler& sampler, SquarePoint u) {
  if constexpr (TexelSampler<Sampler>) {
    return sampler.positions().direction(sampler.draw(u));
  } else if constexpr (requires { sampler.mapping(); }) {
    const TexelSample sample = sampler.sample(u);
    return {direction_at(sampler.mapping(), sample.at),
            to_solid_angle(sampler.mapping(), sample.pdf, sample.at), sample.x, sample.y};
  } else {
    const TexelSample sample = sampler.sample(u);
    return {direction_from_square(sample.at), to_solid_angle(sample.pdf, sample.at), sample.x,
            sample.y};
  }
}

}  // namespace lightproof
