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

/// The declared density: every sampler is held against it by the reference.
struct TargetDensity {
  Weighting weighting;
  LuminanceWeights grey = kRec709;
  friend bool operator==(TargetDensity, TargetDensity) = default;
};

}  // namespace lightproof
