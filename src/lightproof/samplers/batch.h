// Many samples at once. Every sampler draws batches; those whose tables suit it do so with vectors
// (Highway: AVX-512, AVX2, SSE4 or, without any of these, the scalar code): look-ups fetch the
// lines that a block of samples needs ahead of reading them, searches take each step for a block
// together. The texels are those of the scalar interface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>

#include "lightproof/core/random.h"
#include "lightproof/samplers/light_sample.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// Where the points of a batch come from: they are given, or they are those of a stream.
class BatchPoints {
 public:
  /// Points that are given, as below_one() takes them; they outlive this.
  explicit BatchPoints(std::span<const SquarePoint> given)
      : given_(given), stream_("", 0), first_(0), is_stream_(false) {}
  /// The points first, first + 1, … of a stream.
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

/// How many samples are drawn between two fetches of points.
inline constexpr std::size_t kBatchBlock = 64;

/// Samples as directions, each number in an array of its own; all of one size.
struct DirectionBatch {
  std::span<double> x;             ///< x of the unit vectors
  std::span<double> y;             ///< y of the unit vectors
  std::span<double> z;             ///< z of the unit vectors
  std::span<double> pdf;           ///< density of each direction, per steradian
  std::span<std::int32_t> column;  ///< column of each sample's texel
  std::span<std::int32_t> row;     ///< row of each sample's texel

  std::size_t size() const { return pdf.size(); }
};

/// Where the samples of a batch go: as points of the map or as directions.
using BatchOutput = std::variant<std::span<TexelSample>, DirectionBatch>;

/// Writes a sample as the i-th of a batch.
inline void put(const TexelSample& sample, std::size_t i, std::span<TexelSample> samples) {
  samples[i] = sample;
}
/// Writes a sample as the i-th direction of a batch.
inline void put(const LightSample& sample, std::size_t i, const DirectionBatch& directions) {
  directions.x[i] = sample.direction.x;
  directions.y[i] = sample.direction.y;
  directions.z[i] = sample.direction.z;
  directions.pdf[i] = sample.pdf.value;
  directions.column[i] = sample.x;
  directions.row[i] = sample.y;
}

/// Draws the i-th sample of a batch, as a point of the map.
template <EnvSampler Sampler>
void draw_at(const Sampler& sampler, SquarePoint u, std::size_t i, std::span<TexelSample> samples) {
  put(sampler.sample(u), i, samples);
}
/// Draws the i-th sample of a batch, as a direction.
template <MappedSampler Sampler>
void draw_at(const Sampler& sampler, SquarePoint u, std::size_t i,
             const DirectionBatch& directions) {
  put(sample_direction(sampler, u), i, directions);
}

/// How many samples are drawn together by a sampler that can do so.
inline constexpr std::size_t kTogether = 8;

/// A sampler that draws several samples faster than one after the other, without vectors.
template <class T>
concept InterleavedSampler = TexelSampler<T> &&
    requires(const T sampler, std::span<const SquarePoint, kTogether> points,
             std::span<TexelDraw, kTogether> draws) {
  sampler.draw_together(points, draws);
};

/// Draws the first samples of these points, as many whole groups as there are. Returns how many
/// samples these are.
template <InterleavedSampler Sampler, class Output>
std::size_t draw_groups(const Sampler& sampler, std::span<const double> s,
                        std::span<const double> t, std::size_t first, const Output& output) {
  std::array<SquarePoint, kTogether> points;
  std::array<TexelDraw, kTogether> draws;
  std::size_t done = 0;
  for (; done + kTogether <= s.size(); done += kTogether) {
    for (std::size_t i = 0; i < kTogether; ++i) points[i] = {s[done + i], t[done + i]};
    sampler.draw_together(std::span<const SquarePoint, kTogether>(points),
                          std::span<TexelDraw, kTogether>(draws));
    for (std::size_t i = 0; i < kTogether; ++i) {
      if constexpr (std::is_same_v<Output, DirectionBatch>) {
        put(sampler.positions().direction(draws[i]), first + done + i, output);
      } else {
        put(sampler.positions().sample(draws[i]), first + done + i, output);
      }
    }
  }
  return done;
}

/// Draws the i-th sample of the output at the i-th of these points. Returns how many samples
/// vectors drew, from the front: 0 of a sampler without a vectorised form.
template <EnvSampler Sampler, class Output>
std::size_t draw_batch(const Sampler& sampler, const BatchPoints& points, const Output& output) {
  std::size_t by_vectors = 0;
  if constexpr (requires { sampler.view(); }) {
    // Vectors know the directions of one mapping.
    bool is_known = true;
    if constexpr (std::is_same_v<Output, DirectionBatch>) is_known = is_on_plain_map(sampler);
    if (is_known) by_vectors = sample_vectors(sampler.view(), points, output);
  }
  std::size_t done = by_vectors;
  alignas(64) std::array<double, kBatchBlock> s;
  alignas(64) std::array<double, kBatchBlock> t;
  while (done < output.size()) {
    const std::size_t count = std::min(kBatchBlock, output.size() - done);
    points.fill(done, std::span(s).first(count), std::span(t).first(count));
    std::size_t next = 0;
    if constexpr (InterleavedSampler<Sampler>) {
      next =
          draw_groups(sampler, std::span(s).first(count), std::span(t).first(count), done, output);
    }
    for (; next < count; ++next) draw_at(sampler, {s[next], t[next]}, done + next, output);
    done += count;
  }
  return by_vectors;
}

/// Draws samples[i] at points[i]; both spans are of one size. Returns how many samples vectors
/// drew.
template <EnvSampler Sampler>
std::size_t sample(const Sampler& sampler, std::span<const SquarePoint> points,
                   std::span<TexelSample> samples) {
  return draw_batch(sampler, BatchPoints(points), samples);
}

/// Draws samples[i] at the point first + i of the stream. Returns how many samples vectors drew.
template <EnvSampler Sampler>
std::size_t sample(const Sampler& sampler, const RandomStream& stream, std::uint64_t first,
                   std::span<TexelSample> samples) {
  return draw_batch(sampler, BatchPoints(stream, first), samples);
}

/// Draws a sample at each of these points, as many as there are directions, as directions: those of
/// their positions and their densities per steradian, to some roundings. Returns how many samples
/// vectors drew.
template <MappedSampler Sampler>
std::size_t sample_directions(const Sampler& sampler, std::span<const SquarePoint> points,
                              const DirectionBatch& directions) {
  return draw_batch(sampler, BatchPoints(points), directions);
}

/// Draws samples at the points first, first + 1, … of the stream as directions: those of their
/// positions and their densities per steradian, to some roundings. Returns how many samples vectors
/// drew.
template <MappedSampler Sampler>
std::size_t sample_directions(const Sampler& sampler, const RandomStream& stream,
                              std::uint64_t first, const DirectionBatch& directions) {
  return draw_batch(sampler, BatchPoints(stream, first), directions);
}

}  // namespace lightproof
