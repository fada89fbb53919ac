// What a texel is to be drawn in proportion to.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// The luminance of every texel; under B times its solid angle. Throws InputError if the
/// map is black.
Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target);

/// Those of the texels of one row, map.radiance's width of them.
void weigh_row(const EnvironmentMap& map, TargetDensity target, int y, std::span<double> weights);

/// Weights of cells, >= 0, to be had a block at a time and as often as wanted: stored ones, or
/// those of a map's texels, which are computed each time (quicker than memory for all of them).
class CellWeights {
 public:
  /// Stored weights, which outlive this.
  explicit(false) CellWeights(std::span<const double> weights);
  /// As texel_weights(); the map outlives this. Throws InputError if it is black.
  CellWeights(const EnvironmentMap& map, TargetDensity target);

  std::size_t count() const { return count_; }
  /// Writes those of the cells from `first` on.
  void get(std::size_t first, std::span<double> weights) const { get_(first, weights); }

 private:
  std::size_t count_;
  std::function<void(std::size_t first, std::span<double> weights)> get_;
};

/// The error of a map without light.
[[noreturn]] void refuse_black(const EnvironmentMap& map);

}  // namespace lightproof
