// Tests of means and variances against exact values, and of two means against each other.
#pragma once

#include "lightproof/core/moments.h"

namespace lightproof {

/// A deviation in standard errors and its two-sided p-value.
struct ZTest {
  double z = 0.0;        ///< deviation in standard errors
  double log10_p = 0.0;  ///< log10 of the two-sided p-value
  double effect = 0.0;   ///< relative deviation from the expectation
};

/// What is known exactly of the samples whose mean is tested.
struct ExactMoments {
  double mean = 0.0;
  double variance = 0.0;           ///< positive
  double largest_deviation = 0.0;  ///< farthest that a sample is from the mean; 0: not known
};

/// log10 P(|mean - exact| >= z standard errors) over so many samples, or a bound of it. It is the
/// normal tail, as long as skewness, at most largest_deviation / sigma, changes it by less than a
/// factor of two (Cramér's, exp(skewness z^3 / (6 sqrt N))); farther out Bennett's bound (1962),
/// which holds for any distribution so bounded, or the normal tail from where it last held. So a
/// rare, bright sample that turns up a little early proves nothing.
double log10_tails_of_mean(double z, double samples, const ExactMoments& moments);

/// The factor 1 + effect on all samples at which mean_test() of size `level` rejects with this
/// power; `exact` is what is estimated. The samples' scatter grows by the factor too. The threshold
/// is that of log10_tails_of_mean(); below its mean a skewed distribution scatters less than a
/// normal one. Infinite if the samples are too few for any factor.
double minimum_detectable_factor(double level, double power, double samples,
                                 const ExactMoments& moments, double exact);

/// The exact moments of the squared deviations from the mean, whose own mean is the variance.
ExactMoments moments_of_squares(const ExactMoments& moments, double fourth_central);

/// The exact moments with which log10_tails_of_mean() judges a difference of two means over the
/// size of the first set of samples, which is `ratio` times that of the second: the variance is
/// first.variance + ratio second.variance, the mean that of the first.
ExactMoments moments_of_difference(const ExactMoments& first, const ExactMoments& second,
                                   double ratio);

/// Tests the mean of `measured` against the exact one. An exact variance of zero is no case for a
/// z-test; see gate/exact_checks.
ZTest mean_test(const Moments& measured, const ExactMoments& exact);

/// Tests the sample variance, as the mean of the squared deviations, against the exact one; its
/// standard error is sqrt((mu4 - sigma^4) / N) with the exact fourth central moment.
ZTest variance_test(const Moments& measured, const ExactMoments& exact,
                    double exact_fourth_central);

/// Tests whether two independent samples are of one mean: Welch 1947, with the normal tail (use
/// N >= 1e4, where the t distribution's tail is the normal's).
ZTest welch_test(const Moments& first, const Moments& second);

/// Tests whether two independent samples have the one mean that they should have, where the moments
/// of both are known: no variance is estimated.
ZTest two_mean_test(const Moments& first, const ExactMoments& first_exact, const Moments& second,
                    const ExactMoments& second_exact);

}  // namespace lightproof
