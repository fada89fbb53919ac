// Whether one set of measurements tends to be larger than another, without a model of their
// distribution: Mann & Whitney (1947). Measured times are skewed and have outliers, which ranks do
// not feel.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof {

/// How many values in both sets together have an exact p-value; that of more comes from the normal
/// distribution.
inline constexpr std::size_t kLargestExactRanks = 64;

/// The outcome of a one-sided test of two sets.
struct MannWhitney {
  double u = 0.0;        ///< pairs in which the value of `second` is larger; a tie counts one half
  double log10_p = 0.0;  ///< log10 P(U >= u) if all values come from one distribution
  bool exact = false;    ///< whether the p-value is that of all ways to divide the values
};

/// Whether `second` tends to be larger than `first`: then p is small. The exact distribution is
/// that of all ways to divide the values at hand, ties included; the normal one has the tie
/// correction and the continuity correction. Two empty sets, or one, give p = 1. No value may be
/// NaN.
MannWhitney mann_whitney_larger(std::span<const double> first, std::span<const double> second);

/// log10 of the two-sided p-value: twice the smaller of both one-sided ones, at most 1.
double log10_mann_whitney_different(std::span<const double> first, std::span<const double> second);

/// log10 of the smallest p-value that sets of these sizes can have: 1 / C(first + second, second).
double log10_least_mann_whitney(std::size_t first, std::size_t second);

}  // namespace lightproof
