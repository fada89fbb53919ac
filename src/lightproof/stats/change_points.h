// Where a series of measurements changes its level.
//
// Binary segmentation (Scott & Knott 1974) by ranks: the split with the smallest two-sided
// Mann-Whitney p-value is a change if that p-value, times the number of splits tried (Bonferroni),
// is at most alpha and the medians differ by a factor beyond `least_ratio`; both sides are then
// searched in the same way. A series without any change gets a mark with a probability of at most
// alpha, because the first split must pass. CUSUM and penalised likelihoods see a change sooner,
// but take the noise to be normal and of known size.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightproof {

/// Two levels that follow each other.
struct ChangePoint {
  std::size_t first = 0;  ///< the place of the first value of the new level
  double ratio = 1.0;     ///< median of the new level / median of the old one
  double log10_p = 0.0;   ///< two-sided, between the two levels, corrected for the splits tried
};

struct ChangeRule {
  double alpha = 0.01;        ///< probability of any mark in a series without a change
  double least_ratio = 1.05;  ///< of the larger median to the smaller one
};

/// The changes in ascending order. Values are positive.
std::vector<ChangePoint> change_points(std::span<const double> values, const ChangeRule& rule);

}  // namespace lightproof
