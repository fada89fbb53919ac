// What a sampler declares of its own rounding: how far the probability of a texel may be from the
// declared one.
#pragma once

#include <cstddef>

#include "lightproof/core/grid.h"

namespace lightproof {

/// Probabilities around a texel.
struct TexelMasses {
  double texel;        ///< probability of the texel
  double run;          ///< probability of the 32 texels of its row that share a run with it
  double row;          ///< probability of its row
  std::size_t texels;  ///< how many texels the map has
};

/// The parts of a bound on the error of a texel's probability; all 0 for a sampler that claims the
/// declared density exactly.
struct MassRounding {
  double relative = 0.0;    ///< error relative to the texel's own probability
  double of_sums = 0.0;     ///< step of the sums of rows, and of the sums of a row's columns
  double of_run = 0.0;      ///< error relative to the run's probability
  double of_average = 0.0;  ///< error relative to the average probability of a texel

  /// Bound on the error of the texel's probability.
  double bound(const TexelMasses& masses) const {
    const double share = masses.row > 0.0 ? masses.texel / masses.row : 0.0;
    return relative * masses.texel + of_sums * (masses.row + share) + of_run * masses.run +
           of_average / static_cast<double>(masses.texels);
  }
};

/// What a sampler by sums of rows and columns in steps of `step` declares on a map of this extent:
/// CDF entries are each rounded to the nearest, after every lit cell got one step of its own out of
/// the whole: two steps a cell, and a share of the cells for all of them.
constexpr MassRounding rounding_of_sums(Extent map, double step) {
  return {.relative = step * (map.width + map.height), .of_sums = 2.0 * step};
}
/// rounding_of_sums() of sums in single precision.
constexpr MassRounding rounding_of_float_sums(Extent map) { return rounding_of_sums(map, 0x1p-24); }

}  // namespace lightproof
