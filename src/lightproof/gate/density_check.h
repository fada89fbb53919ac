// A sampler's pdf against the declared density, cell by cell: where it has one, support is a matter
// of fact, not of counting.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/samplers/mass_rounding.h"

namespace lightproof {

/// The pdf and the declared density in one cell, over the square.
struct ComparedCell {
  int x = 0;              ///< column of the texel that the cell lies in
  int y = 0;              ///< row of that texel
  SquarePoint at;         ///< in the cell, at 1/4 of its height: see compare_density
  double pdf = 0.0;       ///< the sampler's density, per unit square
  double declared = 0.0;  ///< the declared density, per unit square
};

/// The least and the largest of some ratios.
struct RatioRange {
  double least = INFINITY;
  double largest = 0.0;

  void add(double ratio);
  void merge(const RatioRange& other);
  /// Whether the ratios are all alike, to the rounding of floats, and not 0.
  bool is_constant() const;
};

/// What a comparison of the pdf with the declared density found in all cells in which the latter is
/// smooth.
struct DensityComparison {
  std::string_view compared = "cells";  ///< what is counted below: cells, or samples
  std::size_t unreachable_cells = 0;    ///< cells with a declared density above 0 and a pdf of 0
  double unreachable_mass = 0.0;        ///< share of all light that lies in unreachable cells
  std::optional<ComparedCell> first_unreachable;
  /// Unreachable cells with more light than the sampler declares that its rounding may lose.
  std::size_t undeclared_unreachable_cells = 0;
  std::optional<ComparedCell> first_undeclared_unreachable;
  std::size_t unlit_cells = 0;  ///< cells with a declared density of 0 and a pdf above 0 or NaN
  std::optional<ComparedCell> first_unlit;
  double largest_error = 0.0;         ///< largest relative error of a cell with declared density
  std::size_t cells_off = 0;          ///< cells off by more than the sampler's declared rounding
  std::optional<ComparedCell> worst;  ///< the cell that is off by most beyond that rounding
  /// What the sampler's rounding does to an estimator of one value everywhere: the variance of
  /// declared density over pdf, relative to their square, and the largest deviation.
  double rounding_variance = 0.0;
  double largest_weight_error = 0.0;
  RatioRange ratio;           ///< pdf over declared density, in lit cells
  RatioRange times_jacobian;  ///< that ratio times d(omega)/(ds dt), 2 pi^2 sin(theta) or another
  RatioRange over_jacobian;   ///< that ratio over it
  /// The pdf over that of the declared masses, spread inside the texels by the other measure than
  /// the declared one. Stays empty if the declared density is no masses of texels, or the mapping
  /// leaves no choice of measures.
  RatioRange over_other_measure;

  /// Adds the ratio of the two densities of a cell, whose declared one is positive, to `ratio`,
  /// `times_jacobian` and `over_jacobian`, and its error to `largest_error`. Returns the ratio.
  double add_ratio(const ComparedCell& cell, const Mapping& mapping);
};

/// Compares a sampler's pdf with the declared density, given the rounding that the sampler
/// declares. At the centre of a texel a density that is uniform in t and one that is uniform in
/// cos(theta) are all but one: what is compared is a quarter of the height away from it.
DensityComparison compare_density(const BoundSampler& sampler, const Expectation& expectation,
                                  const MassRounding& rounding);

/// Whether positions inside texels of a map may be uniform in either of two measures.
constexpr bool has_two_measures(const Mapping& mapping) {
  return mapping.kind == MappingKind::lat_long;
}

/// The declared density over the square at a point of texel (x, y).
double declared_density(const Expectation& expectation, SquarePoint at, int x, int y);

}  // namespace lightproof
