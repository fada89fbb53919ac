// What a sampler of an environment map claims to draw.
#pragma once

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// How the luminance g of a texel becomes the density that is drawn.
enum class DensitySpace {
  /// A: the texture-space density of the lecture, over (s,t) in proportion to luminance; uniform in
  /// t inside a texel.
  texture,
  /// B: the solid-angle density, over directions in proportion to luminance; uniform in cos(theta)
  /// inside a texel.
  solid_angle,
};

/// The label of a density in tables: "A" or "B".
constexpr const char* to_string(DensitySpace density_space) {
  return density_space == DensitySpace::texture ? "A" : "B";
}

/// What the map is taken to be between the centres of its texels.
enum class Lookup {
  nearest,   ///< constant inside each texel
  bilinear,  ///< interpolated between the four nearest centres: s wraps around, t is clamped
};

/// The density that is declared, against which the reference holds every sampler. With a bilinear
/// look-up it is in proportion to the interpolated luminance, at every position: over (s,t) under
/// A, over directions under B.
struct TargetDensity {
  DensitySpace density_space;
  /// Weights of the luminance; Rec. 709 gives way to the map's own weights, see on_map().
  LuminanceWeights weights = kRec709;
  Lookup lookup = Lookup::nearest;
  friend bool operator==(TargetDensity, TargetDensity) = default;
};

/// The density that is declared on this map: by the map's own luminance weights, unless weights
/// other than Rec. 709 were declared.
inline TargetDensity on_map(TargetDensity declared, const EnvironmentMap& map) {
  if (declared.weights == kRec709) declared.weights = map.weights;
  return declared;
}

}  // namespace lightproof
