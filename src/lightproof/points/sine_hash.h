// The hash by a sine that shaders pass on, fract(sin(x · (12.9898, 78.233)) 43758.5453), in float.
// Of unknown origin; Rey 1998 has y = (a + x) sin(b x) modulo 1.
#pragma once

#include <cmath>
#include <cstdint>

#include "lightproof/points/point_set.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// Every product and sum rounded to float; the sine is that of the float, correctly rounded but for
/// rare ties, which few graphics processors reach. The factor 43758.5453 leaves 8 to 10 bits behind
/// the point of most values, so that many places share one.
inline float sine_hash(float x, float y) {
  const float angle = x * 12.9898F + y * 78.233F;
  return fract(static_cast<float>(std::sin(static_cast<double>(angle))) * 43758.5453F);
}

/// The hash of (index, 2k) and (index, 2k + 1), where the seed gives k in [0, 2^16).
class SineHashPoints {
 public:
  explicit SineHashPoints(PointSeed seed)
      : row_(2.0F * static_cast<float>(shift_of(seed).s >> 16U)) {}

  SquarePoint point(std::uint32_t index) const {
    const auto x = static_cast<float>(index);
    return {sine_hash(x, row_), sine_hash(x, row_ + 1.0F)};
  }
  /// The formula of point() in double.
  SquarePoint exact_point(std::uint32_t index) const {
    return {in_double(index, row_), in_double(index, static_cast<double>(row_) + 1.0)};
  }

 private:
  static double in_double(double x, double y) {
    const double value = std::sin(x * 12.9898 + y * 78.233) * 43758.5453;
    return value - std::floor(value);
  }

  float row_;
};

}  // namespace lightproof
