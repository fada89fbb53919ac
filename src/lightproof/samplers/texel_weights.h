// What a texel is to be drawn in proportion to.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// The weights of all texels, a grid of the map's extent: their luminance, under B and C times
/// their solid angle. Throws InputError if the map is black, or if a weight is negative or no
/// finite number.
Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target);

/// Writes the weights of the texels of row y, as many as the map has columns: their luminance,
/// under B and C times their solid angle, unless all texels have the same. Throws InputError if a
/// weight is negative or no finite number.
void weigh_row(const EnvironmentMap& map, TargetDensity target, int y, std::span<double> weights);

/// Weights of cells, >= 0, to be had a block at a time and as often as wanted: stored ones, or
/// those of a map's texels, which are computed each time (quicker than memory for all of them).
class CellWeights {
 public:
  /// Weights that are stored, and outlive this.
  explicit(false) CellWeights(std::span<const double> weights);
  /// The weights of a map's texels, as texel_weights() gives them; the map outlives this. Throws
  /// InputError if it is black; get() throws it if a weight is negative or no finite number.
  CellWeights(const EnvironmentMap& map, TargetDensity target);

  std::size_t count() const { return count_; }
  /// Writes the weights of the cells from `first` on, as many as fit.
  void get(std::size_t first, std::span<double> weights) const { get_(first, weights); }

 private:
  std::size_t count_;
  std::function<void(std::size_t first, std::span<double> weights)> get_;
};

/// Refuses a map without light: throws InputError.
[[noreturn]] void refuse_black(const EnvironmentMap& map);

/// Refuses a map some of whose texels have a luminance that is negative or no finite number: throws
/// InputError.
[[noreturn]] void refuse_impossible(const EnvironmentMap& map);

}  // namespace lightproof
