// A sampler's pdf against the declared density, cell by cell: where it has one, support is a matter
// of fact, not of counting.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/samplers/mass_rounding.h"

namespace lightproof {

/// The pdf and the declared density at the centre of one cell, over the square.
struct ComparedCell {
  int x = 0;  ///< texel
  int y = 0;
  SquarePoint at;
  double pdf = 0.0;
  double declared = 0.0;
};

/// The least and the largest of some ratios.
struct RatioRange {
  double least = INFINITY;
  double largest = 0.0;

  void add(double ratio);
  void merge(const RatioRange& other);
  /// All alike, to the rounding of floats, and not 0.
  bool is_constant() const;
};

/// At the centres of all cells in which the declared density is smooth.
struct DensityComparison {
  std::size_t unreachable_cells = 0;  ///< declared above 0, pdf 0
  double unreachable_mass = 0.0;      ///< of all light, in these
  std::optional<ComparedCell> first_unreachable;
  /// Unreachable beyond what the sampler's rounding is declared to make.
  std::size_t lost_cells = 0;
  std::optional<ComparedCell> first_lost;
  std::size_t unlit_cells = 0;  ///< declared 0, pdf above 0 or not a number
  std::optional<ComparedCell> first_unlit;
  double largest_error = 0.0;         ///< relative, of cells that the declaration lets be reached
  std::size_t cells_off = 0;          ///< beyond what the sampler's rounding is declared to make
  std::optional<ComparedCell> worst;  ///< farthest beyond
  /// What the sampler's rounding does to an estimator of one value everywhere: the variance of
  /// declared density over pdf, relative to their square, and the largest deviation.
  double rounding_variance = 0.0;
  double largest_weight_error = 0.0;
  RatioRange ratio;           ///< pdf over declared density, of lit cells
  RatioRange times_jacobian;  ///< the same times 2 pi^2 sin(theta), and divided by it
  RatioRange over_jacobian;
};

/// Compares them, given the rounding that the sampler declares.
DensityComparison compare_density(const BoundSampler& sampler, const Expectation& expectation,
                                  const MassRounding& rounding);

/// The declared density over the square at a point of texel (x, y).
double declared_density(const Expectation& expectation, SquarePoint at, int x, int y);

}  // namespace lightproof
