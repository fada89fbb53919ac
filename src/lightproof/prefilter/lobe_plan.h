// How the convolution with a lobe is divided between spherical harmonics and sums over the texels
// near its axis.
//
// Most lobes take harmonics alone: their zonal factors fade exponentially. Two kinds do not. A lobe
// much narrower than a degree would take more harmonics than the transform has: a smooth window
// cuts it in two, a part near the axis, which is summed over texels, and a rest without a peak,
// which is left to harmonics; so a power-law tail costs nothing. A lobe that is broad and ends at
// the horizon with a jump has factors that fall off like l^(-3/2): it is summed over texels as a
// whole.
//
// A broad lobe of GGX reaches the horizon with a slope: its factors fall off like l^(-5/2), and
// what is left out shows where a sun stands on the horizon. A clamped cosine of the same slope,
// whose part is the irradiance in closed form, takes the slope away.
#pragma once

#include <optional>
#include <vector>

#include "lightproof/prefilter/lobe.h"
#include "lightproof/prefilter/texel_stencil.h"

namespace lightproof {

/// What is left out of a lobe's harmonics, root mean square, relative to the lobe: the error of the
/// picture of a small sun.
inline constexpr double kHarmonicsTolerance = 1e-7;

struct LobePlan {
  std::vector<double> factors;       ///< of the harmonics; empty if they have no part
  std::optional<ZonalKernel> local;  ///< summed over texels, relative to its value on the axis
  double local_share = 0.0;          ///< of the whole lobe
  double cosine_share = 0.0;         ///< of the whole lobe: a clamped cosine, without harmonics
};

LobePlan plan_lobe(const Lobe& lobe);

}  // namespace lightproof
