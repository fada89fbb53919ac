// Tests of a mean for values of which nothing is known but that they are not negative: their
// variance may be infinite.
//
// A gambler who stakes the share lambda of his capital on every value X, at the fair price of 1 for
// X / mean, multiplies it by 1 + lambda (X / mean - 1); by a fair game it does not grow on average,
// so that it exceeds E with a probability of 1/E at the most (Ville 1939; Waudby-Smith & Ramdas
// 2024). log(1+y) >= y - c(a) y^2 for all y >= -a, c(a) = (-a - log(1-a)) / a^2, bounds the capital
// from below by the sums of the values and of their squares. The evidence is the average over the
// stakes 2^-1, 2^-2, …, 2^-24.
#pragma once

#include <cstdint>

namespace lightproof {

/// What is kept of independent values that are not negative.
struct ValueSums {
  std::uint64_t count = 0;
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    ++count;
    sum += value;
    squares += value * value;
  }
  void merge(const ValueSums& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
};

/// log10 of the evidence that the values' mean is more than `mean`. Whatever the values'
/// distribution, it exceeds x with a probability of 10^-x at the most if their mean is not: 10 to
/// minus the evidence is a p-value.
double log10_evidence_above(const ValueSums& values, double mean);

/// log10 of the evidence that the values' mean is less than `mean`, or that some values are more
/// than `largest`, which must be at least `mean`.
double log10_evidence_below(const ValueSums& values, double mean, double largest);

/// By how much, relative, the mean of values must be off for an evidence of 10^log10_enough with a
/// power of 99 %, given their variance over the square of their mean; on either side, where none is
/// more than `largest` times the mean. Infinite for no values.
double detectable_by_evidence(double log10_enough, std::uint64_t count, double relative_variance,
                              double largest);

}  // namespace lightproof
