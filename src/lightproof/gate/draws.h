// What the gate keeps of the samples that it draws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/gate/successive.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {

/// A sample that should not be, the point that it came from, which is not a number where the source
/// has an order of its own, and its number in that order or among the points.
struct InvalidSample {
  SquarePoint u;
  TexelSample sample;
  std::uint64_t number;
};

/// Samples of one kind that should not be: how many, and the first of them.
struct InvalidSamples {
  std::uint64_t count = 0;
  std::optional<InvalidSample> first;

  void add(const InvalidSample& sample) {
    if (count++ == 0) first = sample;
  }
  void merge(const InvalidSamples& other) {
    if (count == 0) first = other.first;
    count += other.count;
  }
};

/// Counts and moments; `merge` in a fixed order gives the same bits however the work was split.
struct Draws {
  /// Without texels if the map is empty, without `marginal` and `column_marginal` if `cells` is 0.
  explicit Draws(Extent map, std::size_t bands, std::size_t cells = kUniformCells);

  std::uint64_t samples = 0;
  Grid<std::uint64_t> bins;
  Grid<std::uint64_t> texels;
  /// Counts over kUniformCells of the coordinates of reference::RosenblattPoint.
  std::vector<std::uint64_t> marginal;
  std::vector<std::uint64_t> column_marginal;
  Grid<std::uint64_t> pairs;  ///< counts of (conditional, marginal) over kPairBins
  SuccessiveCounts successive;
  std::uint64_t repeats = 0;  ///< samples at exactly the position of the one before
  /// Counts of positions within the texel, by the shares of row and cell that
  /// reference::RosenblattPoint names: a row of counts for every band of the expectation.
  Grid<std::uint64_t> positions;
  /// Samples whose marginal, or conditional, coordinate is all but a multiple of 2^-20.
  std::uint64_t marginal_on_lattice = 0;
  std::uint64_t conditional_on_lattice = 0;
  std::array<Moments, kMeanCaseCount> estimators;
  Moments inverse_pdf;
  InvalidSamples out_of_domain;  ///< samples beside the map, or without a density
  InvalidSamples zero_density;   ///< samples in a texel without light

  void merge(const Draws& other);
  /// What it takes of memory, about: the counts of texels and of uniform coordinates.
  std::size_t bytes() const;
};

/// Bins of the pair of transformed coordinates, which are uniform and independent.
inline constexpr Extent kPairBins = {32, 32};

/// Whether a sample lies on the map and names a texel of it, with a positive, finite density.
bool is_on_map(const TexelSample& sample, Extent map);

/// The integrals of kMeanCases, estimated from directions drawn uniformly over the sphere.
using UniformEstimates = std::array<Moments, kMeanCaseCount>;
UniformEstimates draw_uniformly(const Expectation& expectation, const RandomStream& stream,
                                std::uint64_t count);

/// The points first, first + 1, …, `count` of them, of a stream.
struct PointRange {
  std::uint64_t first;
  std::uint64_t count;
};

/// Draws these points of the stream, or the samples of these numbers of a source that has an order
/// of its own, in parallel.
Draws draw_samples(const BoundSampler& sampler, const Expectation& expectation,
                   const RandomStream& stream, PointRange range);

/// Points that a sampler that inverts the marginal of the rows by u.t takes to a band of rows:
/// uniform over the band's share of u.t and `margin` on either side of it, by which the sampler's
/// own sums may be off.
struct DirectedPoints {
  std::size_t band;
  double margin;
  RandomStream stream;
  std::uint64_t count;
};

/// Adds the positions of samples at points that lead to one band of rows. What lands in another
/// band is left out: given the row, its share below the sample is uniform all the same.
void add_directed_positions(Draws& draws, const BoundSampler& sampler,
                            const Expectation& expectation, const DirectedPoints& directed);

/// Counts of the rows of a grid of counts.
std::vector<std::uint64_t> row_counts(const Grid<std::uint64_t>& texels);
/// Counts of the columns of a grid of counts.
std::vector<std::uint64_t> column_counts(const Grid<std::uint64_t>& texels);

}  // namespace lightproof
