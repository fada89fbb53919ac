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

struct UniformityTest {
  double statistic = 0.0;
  double log10_p = 0.0;
  double distance =
      0.0;  ///< between the distributions: largest, or root of the weighted mean square
};

/// Kuiper's V = D+ + D-, which does not depend on where a circle is cut, scaled by Stephens (1970)
/// so that one distribution serves every number of samples; 0 samples give p = 1.
UniformityTest kuiper_test(std::span<const std::uint64_t> counts);

/// Anderson and Darling's A^2 (1954), which weighs both ends: N ∫ (F_N - F)^2 / (F (1-F)) dF.
UniformityTest anderson_darling_test(std::span<const std::uint64_t> counts);

/// The `distance` between the true distribution and the uniform one that a test of size `level`
/// finds with at least `power`. Kuiper: F_N between the two farthest positions is a binomial share,
/// of standard deviation 1/(2 sqrt N) at most. Anderson-Darling: the weighted deviation, projected
/// on the true one, is a normal of variance 1/2 at most, the largest eigenvalue of its kernel.
double minimum_detectable_kuiper_distance(double level, double power, double samples);
double kuiper_power(double distance, double level, double samples);  ///< at least
double minimum_detectable_anderson_darling_distance(double level, double power, double samples);
double anderson_darling_power(double distance, double level, double samples);  ///< at least

/// log10 P(sqrt(N) D >= x) for many samples (Kolmogorov 1933).
double log10_kolmogorov_tail(double x);

/// log10 P(Kuiper's scaled statistic >= v).
double log10_kuiper_tail(double v);

/// log10 P(A^2 >= a) for infinitely many samples.
double log10_anderson_darling_tail(double a);

}  // namespace lightproof
