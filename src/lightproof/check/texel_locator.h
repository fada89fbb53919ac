// Directions, which rounding may have moved, as samples of the map's square.
#pragma once

#include <functional>
#include <span>

#include "lightproof/check/lat_long_positions.h"
#include "lightproof/core/grid.h"
#include "lightproof/dump/sample_row.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

/// Puts samples into texels. One whose direction lies within its rounding of the edge of a texel
/// counts for the texel on either side whose declared density is nearer to the sample's own, or,
/// without a density, for the likelier one: what lies beside a sun would else get samples of the
/// sun.
class TexelLocator {
 public:
  /// The declared density over the square at a point of texel (x, y).
  using DeclaredDensity = std::function<double(SquarePoint at, int x, int y)>;

  /// `rounding` in radians.
  TexelLocator(Mapping mapping, Extent extent, double rounding, DeclaredDensity declared);

  /// A sample whose direction is not a number lies nowhere: its position and density are none.
  TexelSample operator()(const DumpedSample& sample) const;

  /// Many at once: on latitude and longitude all but those at poles and near edges by vectors. Both
  /// spans are of one size, for which `positions` is made.
  void operator()(std::span<const DumpedSample> samples, std::span<TexelSample> placed_samples,
                  LatLongPositions& positions) const;

 private:
  TexelSample placed(Direction d, PerSteradian pdf) const;
  bool is_near_edges(SquarePoint at) const;
  /// How badly a texel fits a sample: by the ratio of densities, or else by its own.
  double misfit(const TexelSample& sample) const;

  Mapping mapping_;
  Extent extent_;
  double rounding_;
  DeclaredDensity declared_;
};

}  // namespace lightproof
