// An environment map in the one frame that everything behind the reader works in.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/luminance.h"
#include "lightproof/image/map_origin.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

/// Radiance over all directions, constant inside each texel unless a Lookup says that it is
/// interpolated: column x covers s in [x/W, (x+1)/W), row y covers t in [y/H, (y+1)/H), in the
/// square of the map's mapping, which is `z-up` unless the file has another one: s = 1/2 - phi/2pi,
/// t = 1 - theta/pi. Every value is finite and not negative.
struct EnvironmentMap {
  std::string name;
  Grid<Rgb> radiance;
  /// What the reader changed or assumed, one sentence each ("3 negative texels set to 0: …").
  std::vector<std::string> notes = {};
  /// What the user called the map: a path, or the name of a built-in one. Empty: the name.
  std::string source = {};
  /// Weights of red, green and blue in the map's luminance. Densities that are declared by Rec. 709
  /// follow them.
  LuminanceWeights weights = kRec709;
  MapOrigin origin = {};
  /// How the square of the texels lies on the sphere.
  Mapping mapping = {};
};

/// The luminance of every texel by the map's own weights, a grid of the map's extent.
Grid<double> luminance_of(const EnvironmentMap& map);
/// The luminance of every texel by these weights, a grid of the map's extent.
Grid<double> luminance_of(const EnvironmentMap& map, LuminanceWeights weights);

}  // namespace lightproof
