// The critical value of a test whose tail is known: Boost's bracketing and TOMS 748 (Alefeld, Potra
// and Shi 1995), which needs some ten values of the tail where bisection takes fifty.
#pragma once

#include <functional>

namespace lightproof {

/// The statistic x >= 0 at which an upper tail P(X >= x) falls to a positive level, both given by
/// their decimal logarithms. The tail must never rise; if it jumps over the level, the result is
/// where it does. It is 0 if the tail is at most the level at once. It errs by less than 2^-49 of
/// itself, and only upwards: the tail there is at most the level.
double critical_value(const std::function<double(double)>& log10_tail, double log10_level);

}  // namespace lightproof
