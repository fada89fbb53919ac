// The two pieces of Loader's saddle-point expansion (2000, "Fast and accurate computation of
// binomial probabilities"). Gamma functions and likelihoods of large counts are differences of
// numbers far larger than themselves; written in these pieces nothing large cancels.
#pragma once

namespace lightproof {

/// log Gamma(z) - [(z - 1/2) log z - z + log(2 pi) / 2], for z > 0.
double stirling_remainder(double z);

/// observed log(observed / expected) - observed + expected >= 0, for both positive, without
/// cancellation where they are close; `difference` is observed - expected, for callers who know
/// it better than the subtraction would.
double half_deviance(double observed, double expected, double difference);

inline double half_deviance(double observed, double expected) {
  return half_deviance(observed, expected, observed - expected);
}

}  // namespace lightproof
