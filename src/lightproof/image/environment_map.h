// An environment map in the one frame that everything behind the reader works in.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/luminance.h"
#include "lightproof/image/map_origin.h"

namespace lightproof {

/// Radiance over all directions, constant inside each texel unless a Lookup says that it is
/// interpolated: column x covers s in [x/W, (x+1)/W), row y covers t in [y/H, (y+1)/H), in the
/// `z-up` mapping s = 1/2 - phi/2pi, t = 1 - theta/pi. Every value is finite and not negative.
struct EnvironmentMap {
  std::string name;
  Grid<Rgb> radiance;
  /// What the reader changed or assumed, one sentence each ("3 negative texels set to 0: …").
  std::vector<std::string> notes = {};
  /// What the user called it: a path, or the name of a built-in map. Empty: the name.
  std::string source = {};
  /// Of red, green and blue in the map's luminance: densities that are declared by Rec. 709 follow
  /// them.
  LuminanceWeights weights = kRec709;
  MapOrigin origin = {};
};

/// The luminance of every texel by the map's own weights, same shape as the map.
Grid<double> luminance_of(const EnvironmentMap& map);
/// The same by other weights.
Grid<double> luminance_of(const EnvironmentMap& map, LuminanceWeights weights);

}  // namespace lightproof
