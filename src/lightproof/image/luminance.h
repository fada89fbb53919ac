// The luminance of a linear RGB triple.
#pragma once

#include "lightproof/core/direction.h"

namespace lightproof {

/// Weights of the luminance of a linear RGB triple. Any positive weights give an unbiased sampler.
struct LuminanceWeights {
  double red;
  double green;
  double blue;
  friend bool operator==(LuminanceWeights, LuminanceWeights) = default;
};

/// The luminance weights of Rec. 709 (ITU-R BT.709).
inline constexpr LuminanceWeights kRec709 = {0.2126, 0.7152, 0.0722};
/// The luminance weights that the lecture prints (NTSC-like; they sum to 1.0000).
inline constexpr LuminanceWeights kPublishedLuminance = {0.2989, 0.5866, 0.1145};
/// Luminance weights that give the mean of the three channels.
inline constexpr LuminanceWeights kAverageLuminance = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};

/// The luminance of a linear RGB triple, in the unit of the triple.
inline double luminance_of(Rgb rgb, LuminanceWeights weights = kRec709) {
  return weights.red * static_cast<double>(rgb.r) + weights.green * static_cast<double>(rgb.g) +
         weights.blue * static_cast<double>(rgb.b);
}

}  // namespace lightproof
