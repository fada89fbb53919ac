// How well positions inside texels fit the other measure than the declared one: solid angle where
// (s,t) is declared, or the reverse.
#pragma once

#include "lightproof/gate/draws.h"
#include "lightproof/gate/expectation.h"

namespace lightproof {

/// What the positions of samples say of the two measures.
struct PositionFit {
  /// log10 of how many times likelier they are if positions are uniform in the other measure.
  double log10_odds = 0.0;
  /// log10 of how well they fit it: the smallest p-value of goodness of fit over the bands of rows,
  /// times their number.
  double log10_p = 0.0;
  /// Whether the other measure is likelier by kNamingOdds, and not rejected at kFitLevel.
  bool named() const;
};

/// The fit of the other measure; of a distribution that is no masses of texels neither odds nor
/// p-value say anything.
PositionFit fit_of_other_measure(const Expectation& expectation, const Draws& draws);

}  // namespace lightproof
