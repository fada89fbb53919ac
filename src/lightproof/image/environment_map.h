// An environment map in the one frame that everything behind the reader works in.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Weights of the grey value of a linear RGB triple. Any positive weights give an unbiased sampler.
struct LuminanceWeights {
  double red;
  double green;
  double blue;
  friend bool operator==(LuminanceWeights, LuminanceWeights) = default;
};

/// ITU-R BT.709.
inline constexpr LuminanceWeights kRec709 = {0.2126, 0.7152, 0.0722};
/// As printed in the lecture (NTSC-like; they sum to 1.0000).
inline constexpr LuminanceWeights kPublishedLuminance = {0.2989, 0.5866, 0.1145};

/// Grey value of one texel, in the unit of the radiance.
inline double luminance(Rgb rgb, LuminanceWeights weights = kRec709) {
  return weights.red * static_cast<double>(rgb.r) + weights.green * static_cast<double>(rgb.g) +
         weights.blue * static_cast<double>(rgb.b);
}

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
};

/// The grey value of every texel, same shape as the map.
Grid<double> luminance(const EnvironmentMap& map, LuminanceWeights weights = kRec709);

}  // namespace lightproof
