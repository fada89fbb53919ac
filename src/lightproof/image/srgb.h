// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace lightproof {

/// The encoded value, in [0,1], of a linear one; clamped. NaN becomes 0.
inline double srgb_encoded(double linear) {
  if (!(linear > 0.0)) return 0.0;
  if (linear >= 1.0) return 1.0;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace lightproof
