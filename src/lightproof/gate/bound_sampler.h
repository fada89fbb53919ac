// A sampler whose type no longer matters.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// A sampler of points of the square, built and ready. Its type is erased once per batch, not per
/// sample.
struct BoundSampler {
  /// Both spans have the same length.
  std::function<void(std::span<const SquarePoint>, std::span<TexelSample>)> sample;
  std::function<PerSquare(SquarePoint)> pdf;
};

template <EnvSampler Sampler>
BoundSampler bound(Sampler sampler) {
  auto shared = std::make_shared<const Sampler>(std::move(sampler));
  return {[shared](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
            lightproof::sample(*shared, points, samples);
          },
          [shared](SquarePoint at) { return shared->pdf(at); }};
}

}  // namespace lightproof
