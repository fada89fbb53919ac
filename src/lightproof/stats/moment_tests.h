// Tests of means and variances against exact values, and of two means against each other.
#pragma once

#include "lightproof/core/moments.h"

namespace lightproof {

/// A deviation in standard errors and its two-sided p-value.
struct ZTest {
  double z = 0.0;
  double log10_p = 0.0;
  double effect = 0.0;  ///< relative deviation from the expectation
};

/// The mean of `measured` against an exact mean and variance (of one sample). An exact variance
/// of zero is no case for a z-test; see suite/checks.
ZTest mean_test(const Moments& measured, double expected_mean, double exact_variance);

/// The sample variance against the exact one; its standard error is sqrt((mu4 - sigma^4) / N)
/// with the exact fourth central moment.
ZTest variance_test(const Moments& measured, double exact_variance, double exact_fourth_central);

/// Two independent samples: Welch 1947, with the normal tail (use N >= 1e4, where the t
/// distribution's tail is the normal's).
ZTest welch_test(const Moments& first, const Moments& second);

}  // namespace lightproof
