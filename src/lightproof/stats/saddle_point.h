// The two pieces of Loader's saddle-point expansion (2000, "Fast and accurate computation of
// binomial probabilities"). Gamma functions and likelihoods of large counts are differences of
// numbers far larger than themselves; written in these pieces nothing large cancels.
#pragma once

namespace lightproof {

/// What Stirling's formula leaves of log Gamma(z), for z > 0:
/// log Gamma(z) - [(z - 1/2) log z - z + log(2 pi) / 2].
double stirling_remainder(double z);

/// Half the deviance of a count, observed log(observed / expected) - observed + expected >= 0, for
/// both positive, without cancellation where they are close; `difference` is observed - expected,
/// for callers who know it better than the subtraction would.
double half_deviance(double observed, double expected, double difference);

/// Half the deviance of a count, observed log(observed / expected) - observed + expected >= 0, for
/// both positive, without cancellation in the sum.
inline double half_deviance(double observed, double expected) {
  return half_deviance(observed, expected, observed - expected);
}

}  // namespace lightproof
