// What the gate keeps of the samples that it draws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"
#include "lightproof/suite/expectation.h"
#include "lightproof/suite/subject.h"

namespace lightproof {

/// A sample that left the map, and the point that it came from.
struct Stray {
  SquarePoint u;
  TexelSample sample;
};

/// Counts and moments; `merge` in a fixed order gives the same bits however the work was split.
struct Draws {
  explicit Draws(Extent map);

  Grid<std::uint64_t> bins;
  std::vector<std::uint64_t> rows;
  std::vector<std::uint64_t> columns;
  std::array<Moments, kMeanCaseCount> estimators;
  Moments inverse_pdf;
  std::uint64_t strays = 0;
  std::optional<Stray> first_stray;

  void merge(const Draws& other);
};

/// Whether a sample lies on the map and names a texel of it, with a positive, finite density.
bool is_on_map(const TexelSample& sample, Extent map);

/// Draws the points [first, first + count) of the stream.
Draws draw_samples(const BoundSampler& sampler, const Expectation& expectation,
                   const RandomStream& stream, std::uint64_t first, std::uint64_t count);

}  // namespace lightproof
