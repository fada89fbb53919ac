// Certified bounds of the irradiance of one normal, without the closed form at the horizon: texels
// that it crosses are divided, and what is left undecided is bounded.
#pragma once

#include "lightproof/prefilter/irradiance.h"

namespace lightproof {

/// lower <= E <= upper in red, green and blue, rounding included.
struct IrradianceBracket {
  Irradiance lower;
  Irradiance upper;
};

/// Bounds of the irradiance at the unit vector `normal` (z up). Every texel that the horizon
/// crosses is divided in four so many times; each time the bracket becomes four times as narrow and
/// takes twice as long. A part with V = ∫ w d(omega) that is still crossed has (n·V)+ as its lower
/// bound, by Jensen's inequality, and as its upper one the smaller of its solid angle times the
/// largest n·w in it and of n·V plus its solid angle times the largest -n·w.
IrradianceBracket irradiance_bracket(const EnvironmentMap& map, Direction normal, int divisions);

}  // namespace lightproof
