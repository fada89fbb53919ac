// What a sampler of an environment map claims to draw.
#pragma once

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// How the grey value g of a texel becomes the density that is drawn.
enum class Weighting {
  A,  ///< the lecture's: density over (s,t) proportional to g, uniform in t inside a texel
  B,  ///< density over directions proportional to g, uniform in cos(theta) inside a texel
};

constexpr const char* to_string(Weighting weighting) {
  return weighting == Weighting::A ? "A" : "B";
}

/// What the map is taken to be between the centres of its texels.
enum class Lookup {
  nearest,   ///< constant inside each texel
  bilinear,  ///< interpolated between the four nearest centres: s wraps around, t is clamped
};

/// The declared density: every sampler is held against it by the reference. With a bilinear look-up
/// it is in proportion to the interpolated grey, at every place: over (s,t) under A, over
/// directions under B.
struct TargetDensity {
  Weighting weighting;
  /// Rec. 709 gives way to the map's own weights: see on_map().
  LuminanceWeights grey = kRec709;
  Lookup lookup = Lookup::nearest;
  friend bool operator==(TargetDensity, TargetDensity) = default;
};

/// The density that is declared on this map: by the map's own luminance weights, unless weights
/// other than Rec. 709 were declared.
inline TargetDensity on_map(TargetDensity declared, const EnvironmentMap& map) {
  if (declared.grey == kRec709) declared.grey = map.weights;
  return declared;
}

}  // namespace lightproof
