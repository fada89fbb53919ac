// What a look-up between two levels of a chain loses, harmonic by harmonic: the zonal factors of
// the roughness in between against those that the look-up mixes, linearly in roughness.
#pragma once

#include "lightproof/prefilter/lobe.h"

namespace lightproof {

/// Largest over all degrees up to one and over all places between the levels.
struct InterpolationError {
  double largest;
  /// (R_1 - R_0)^2/8 times the largest second derivative of a factor by roughness: never below.
  double bound;
};

/// The error of interpolation between GGX levels of these roughnesses, 0 <= finer < coarser <= 1, 0
/// being the mirror. The second derivative is taken numerically.
InterpolationError interpolation_error(double finer, double coarser, int degree,
                                       GgxWeight weight = GgxWeight::cosine);

}  // namespace lightproof
