// Are successive numbers independent? From counts of pairs over a grid of equal cells, and from
// sums over short runs.
//
// Pairs (x_i, x_i+lag) overlap: each number is in two of them. What depends on the marginals alone
// is therefore correlated between pairs, but the interaction is not: for mean-zero f and g the
// products f(x_i) g(x_i+lag) are uncorrelated. A test of independence in a contingency table, with
// expectations from its own margins and (r-1)(c-1) degrees of freedom, sees the interaction alone,
// so that its distribution is chi-square in spite of the overlap (Good 1953, "The serial test for
// sampling numbers"), and numbers that are not uniform are no reason to reject.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/stats/goodness_of_fit.h"

namespace lightproof {

/// Whether row and column of a square grid of counts are independent: Cressie and Read's power
/// divergence with lambda = 2/3 from the products of the margins. Neighbouring rows and columns are
/// merged two by two until an average cell holds 25 counts; below 2 x 2 there are 0 degrees of
/// freedom, and nothing can be said. Its p-value is two-sided from 30 degrees of freedom on. The
/// number of rows is a power of two.
GoodnessOfFit independence_fit(const Grid<std::uint64_t>& counts);

/// The sum of statistics whose degrees of freedom add up, over as many samples as the largest has,
/// judged as one.
GoodnessOfFit sum_of_fits(std::span<const GoodnessOfFit> fits, std::uint64_t samples);

/// Degrees of freedom of independence_fit() for so many counts over a grid of `cells` x `cells`
/// cells in which all rows and columns are hit.
double independence_dof(std::uint64_t counts, int cells);

/// P(the sum of `terms` independent uniform numbers of [0,1) <= x) (Irwin 1927, Hall 1927).
double irwin_hall_cdf(int terms, double x);

/// The cells - 1 sums that divide [0, terms] into cells of equal probability, ascending.
std::vector<double> irwin_hall_quantiles(int terms, int cells);

}  // namespace lightproof
