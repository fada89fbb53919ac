// A sampler under test, whatever its type: one of the registry, a mutant, a stranger's.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/samplers/registry.h"

namespace lightproof {

/// A sampler built for one map. Its type is erased once per batch, not per sample.
struct BoundSampler {
  /// Both spans have the same length.
  std::function<void(std::span<const SquarePoint>, std::span<TexelSample>)> sample;
  std::function<PerSquare(SquarePoint)> pdf;
};

template <EnvSampler Sampler>
BoundSampler bound(Sampler sampler) {
  auto shared = std::make_shared<const Sampler>(std::move(sampler));
  return {[shared](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
            for (std::size_t i = 0; i < points.size(); ++i) samples[i] = shared->sample(points[i]);
          },
          [shared](SquarePoint at) { return shared->pdf(at); }};
}

/// What the gate must know of a sampler before it has a map.
struct Subject {
  std::string name;
  TargetDensity target;  ///< what it claims to draw
  bool known_defects = false;
  /// Claims to return the texel of LinearScan for every point.
  bool inverts_shared_cdf = false;
  /// The map outlives what is bound to it. Throws InputError if the map is black.
  std::function<BoundSampler(const EnvironmentMap&)> bind;
};

/// A row of the registry under one weighting.
Subject subject_of(const SamplerInfo& sampler, Weighting weighting);

/// Every sampler of the registry under both weightings.
std::vector<Subject> all_subjects();

}  // namespace lightproof
