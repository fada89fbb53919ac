// Whether numbers in [0,1) are uniform, from their counts over equal cells.
//
// Both statistics read the empirical distribution at the cells' edges only: counts are integers
// that merge in any order, and nothing needs sorting. With 2^16 cells a supremum between edges is
// missed by little: Kuiper's p is a few percent too large, never too small.
#pragma once

#include <cstdint>
#include <span>

namespace lightproof {

/// How many equal cells the gate counts over.
inline constexpr std::size_t kUniformCells = std::size_t{1} << 16U;

/// The outcome of a test of uniformity.
struct UniformityTest {
  double statistic = 0.0;
  double log10_p = 0.0;  ///< log10 P(a statistic as large) if the numbers are uniform
  /// Distance of the empirical distribution from the uniform one: Kuiper's D+ + D-, or Anderson and
  /// Darling's root of the weighted mean square.
  double distance = 0.0;
};

/// Kuiper's test of counts over equal cells: V = D+ + D-, which does not depend on where a circle
/// is cut, scaled by Stephens (1970) so that one distribution serves every number of samples. 0
/// samples give p = 1.
UniformityTest kuiper_test(std::span<const std::uint64_t> counts);

/// Anderson and Darling's test (1954) of counts over equal cells, whose statistic
/// A^2 = N ∫ (F_N - F)^2 / (F (1-F)) dF weighs both ends. 0 samples give p = 1.
UniformityTest anderson_darling_test(std::span<const std::uint64_t> counts);

/// The distance D+ + D- between the true distribution and the uniform one that Kuiper's test of
/// size `level` finds with at least `power`: F_N between the two farthest positions is a binomial
/// share, of standard deviation 1/(2 sqrt N) at most.
double minimum_detectable_kuiper_distance(double level, double power, double samples);

/// The probability, or less, with which Kuiper's test of size `level` finds a distance D+ + D-.
double kuiper_power(double distance, double level, double samples);

/// The distance, the root of the weighted mean square, between the true distribution and the
/// uniform one that Anderson and Darling's test of size `level` finds with at least `power`: the
/// weighted deviation, projected on the true one, is a normal of variance 1/2 at most, the largest
/// eigenvalue of its kernel.
double minimum_detectable_anderson_darling_distance(double level, double power, double samples);

/// The probability, or less, with which Anderson and Darling's test of size `level` finds a
/// distance, the root of the weighted mean square.
double anderson_darling_power(double distance, double level, double samples);

/// log10 P(sqrt(N) D >= x) for many samples (Kolmogorov 1933).
double log10_kolmogorov_tail(double x);

/// log10 P(Kuiper's scaled statistic >= v).
double log10_kuiper_tail(double v);

/// log10 P(A^2 >= a) for infinitely many samples.
double log10_anderson_darling_tail(double a);

}  // namespace lightproof
