// Where series of measurements change their level, over the dependence between neighbours.
//
// What is measured one session after the other is not independent: a machine that is a little slow
// today is often a little slow tomorrow, and a slow week looks like a change of level to any test
// that takes its days for independent (Serinaldi & Kilsby 2016, "The importance of prewhitening in
// change point analysis under persistence"). The null hypothesis here is a series of one level
// whose logarithms deviate from it by normal errors, of one unknown size, with correlations r, r^2,
// r^3, … between neighbours at distance 1, 2, 3, … (a first-order autoregression), of unknown r
// from 0 to kMostCorrelation. Correlations of a step or two, as between commits of one session, are
// less than such errors would have.
//
// The logarithms are described by up to three levels (of n values up to n/24 + 1) of at least
// kShortestLevel values each: the split that leaves the least sum of squares, then the one that
// does so beside it, and so on. The statistic is the clearest step between neighbouring levels: the
// difference of their means over its standard error, from the scatter about the levels and the
// effective number of values, n (1 - r) / (1 + r) for an r estimated about the levels (Bayley &
// Hammersley 1946; its bias corrected as by Marriott & Pope 1954). Further levels are there so that
// their steps do not pass for scatter and correlation where the level changes more than once. How
// the statistic is distributed depends on the number of values and on r alone. It grows with r, as
// short series give r too small, so its p-value is its rank among those of simulated series with
// the largest r (a Monte Carlo test: Barnard 1963). A single outlier is no level: among five values
// it adds to their scatter as much as to their mean.
//
// A level that is told from its neighbour splits the series; both sides are then searched in the
// same way (binary segmentation, Scott & Knott 1974).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightproof {

/// Correlation of neighbours that is reckoned with: a deviation halves in six or seven sessions.
inline constexpr double kMostCorrelation = 0.9;
/// Values that make a level; a series of fewer than two levels is not tested.
inline constexpr std::size_t kShortestLevel = 5;

/// Two levels that follow each other.
struct ChangePoint {
  std::size_t first = 0;  ///< index in the series of the first value of the new level
  double ratio = 1.0;     ///< median of the new level / median of the old one
  double log10_p = 0.0;   ///< log10 P(a series of one level seems to step so clearly, anywhere)
};

/// What counts as a change of level.
struct ChangeRule {
  double alpha = 0.05;        ///< probability of any change in any series if there is none in any
  double least_ratio = 1.05;  ///< least ratio of the larger median to the smaller one
};

/// The changes of each of several series of positive values, in ascending order. Holm's procedure
/// (see stats/family.h) decides which series have any, so that alpha holds for all of them
/// together. They do not depend on the number of threads.
std::vector<std::vector<ChangePoint>> change_points(std::span<const std::vector<double>> series,
                                                    const ChangeRule& rule);

}  // namespace lightproof
