// A sampler whose type no longer matters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// A source of samples over the square, built and ready. Its type is erased once per batch, not per
/// sample. What it cannot do is left empty, and the tests that need it are recorded as not run.
struct BoundSampler {
  /// Draws at given points; both spans have the same length. Empty where samples come in an order
  /// of their own.
  std::function<void(std::span<const SquarePoint>, std::span<TexelSample>)> sample;
  /// The density over the square, per unit square, at any position. Empty where it is not known.
  std::function<PerSquare(SquarePoint)> pdf;
  /// The samples from number `first` on, of a source that takes no points: the same ones whenever
  /// it is asked, and independent of each other. Many threads may ask.
  std::function<void(std::uint64_t first, std::span<TexelSample>)> sample_in_order = {};
  /// How many samples there are in order; none: any number.
  std::optional<std::uint64_t> count = {};
  /// Whether the density that comes with a sample means anything: else estimates cannot be weighed.
  bool has_weights = true;
  /// Densities at many positions, where asking for all at once is much quicker; both spans have the
  /// same length. Empty: pdf() is asked for each.
  std::function<void(std::span<const SquarePoint>, std::span<PerSquare>)> pdfs = {};
  /// By how much, relative, the rounding of its directions changes the density over the square of a
  /// sample at a position; empty where samples are exact.
  std::function<double(SquarePoint)> pdf_rounding = {};
  /// Whether it runs in another process, and any call may throw SamplerFailure.
  bool runs_elsewhere = false;

  bool takes_points() const { return static_cast<bool>(sample); }
  bool has_pdf() const { return static_cast<bool>(pdf); }

  /// The density at each of these positions; both spans have the same length.
  void pdf_at(std::span<const SquarePoint> positions, std::span<PerSquare> densities) const {
    if (pdfs) return pdfs(positions, densities);
    std::transform(positions.begin(), positions.end(), densities.begin(), pdf);
  }
};

/// A sampler as a source of samples at given points, with pdf and weights.
template <EnvSampler Sampler>
BoundSampler bound(Sampler sampler) {
  auto shared = std::make_shared<const Sampler>(std::move(sampler));
  return {[shared](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
            lightproof::sample(*shared, points, samples);
          },
          [shared](SquarePoint at) { return shared->pdf(at); }};
}

}  // namespace lightproof
