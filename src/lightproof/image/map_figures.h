// A map in a few numbers.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A map in a few numbers, all in luminance by the map's own weights.
struct MapFigures {
  double mean_luminance = 0.0;  ///< mean over the sphere by solid angle
  double peak_luminance = 0.0;  ///< luminance of the brightest texel
  int peak_column = 0;          ///< column of the first texel, row by row from t = 0, as bright
  int peak_row = 0;             ///< row of that texel, counted from t = 0
  /// G^2 / (4 pi Q), with G and Q the integrals of luminance and of its square over the sphere: the
  /// share of the sphere that the light fills. NaN for a black map.
  double effective_fraction = 0.0;
};

/// The figures of a map.
MapFigures figures_of(const EnvironmentMap& map);

/// World direction of a texel's centre, z up.
Direction direction_of_texel(Extent map, int column, int row, const Mapping& mapping = {});

}  // namespace lightproof
