// Many samples at once. Every sampler draws batches; those whose tables suit it do so with vectors
// (Highway: AVX-512, AVX2, SSE4 or, without any of these, the scalar code), which fetch the lines
// that a block of samples needs ahead of reading them. The texels are those of the scalar
// interface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/core/random.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// Where the points of a batch come from: they are given, or they are those of a stream.
class BatchPoints {
 public:
  explicit BatchPoints(std::span<const SquarePoint> given)
      : given_(given), stream_("", 0), first_(0), is_stream_(false) {}
  /// The points first, first + 1, … of the stream.
  BatchPoints(const RandomStream& stream, std::uint64_t first)
      : stream_(stream), first_(first), is_stream_(true) {}

  /// Writes the points `from`, from + 1, … of the batch: s[i] and t[i]. Both spans are of one size.
  void fill(std::size_t from, std::span<double> s, std::span<double> t) const;

 private:
  std::span<const SquarePoint> given_;
  RandomStream stream_;
  std::uint64_t first_;
  bool is_stream_;
};

/// Samples between two fetches of points.
inline constexpr std::size_t kBatchBlock = 128;

/// Draws samples[i] at the i-th of these points.
template <EnvSampler Sampler>
void sample(const Sampler& sampler, const BatchPoints& points, std::span<TexelSample> samples) {
  std::size_t done = 0;
  if constexpr (requires { sampler.view(); }) {
    done = sample_vectors(sampler.view(), points, samples);
  }
  alignas(64) std::array<double, kBatchBlock> s;
  alignas(64) std::array<double, kBatchBlock> t;
  while (done < samples.size()) {
    const std::size_t count = std::min(kBatchBlock, samples.size() - done);
    points.fill(done, std::span(s).first(count), std::span(t).first(count));
    for (std::size_t i = 0; i < count; ++i) samples[done + i] = sampler.sample({s[i], t[i]});
    done += count;
  }
}

/// Draws samples[i] at points[i]; both spans are of one size.
template <EnvSampler Sampler>
void sample(const Sampler& sampler, std::span<const SquarePoint> points,
            std::span<TexelSample> samples) {
  sample(sampler, BatchPoints(points), samples);
}

/// Draws samples[i] at the point first + i of the stream.
template <EnvSampler Sampler>
void sample(const Sampler& sampler, const RandomStream& stream, std::uint64_t first,
            std::span<TexelSample> samples) {
  sample(sampler, BatchPoints(stream, first), samples);
}

}  // namespace lightproof
